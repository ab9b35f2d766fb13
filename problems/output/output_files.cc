// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/output_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace phongpd {
namespace fs = std::filesystem;

namespace {

using internal::Descriptor;

constexpr const char* kStandardOutputDevice = "/dev/stdout";
constexpr mode_t kNewFile = 0666;
constexpr std::size_t kLongestName = 180;  // of 255 with what is around it

[[noreturn]] void FailToWrite(const std::string& path,
                              const std::string& reason) {
  throw InputError(path + ": cannot be written (" + reason + ")");
}

// Calls `write`, which throws std::system_error.
template <typename F>
void TryToWrite(const std::string& path, const F& write) {
  try {
    write();
  } catch (const std::system_error& error) {
    FailToWrite(path, error.code().message());
  }
}

// Of all temporaries of one target; long names may share theirs.
std::string TemporaryPrefix(const std::string& leaf) {
  return ".phongpd-" + leaf.substr(0, kLongestName) + "-";
}

bool IsStandardOutput(const std::string& path) {
  return path == kStandardOutput || path == kStandardOutputDevice;
}

// Linux follows such links only if the administrator allows it, and resolving
// a name is no opening of a file, which it would catch.
void RefuseForeignLink(const std::string& path) {
  struct stat link, folder;
  if (lstat(path.c_str(), &link) != 0 || !S_ISLNK(link.st_mode)) return;
  const fs::path parent = fs::path(path).parent_path();
  if (stat(parent.empty() ? "." : parent.c_str(), &folder) != 0) return;
  if ((folder.st_mode & (S_IWGRP | S_IWOTH)) != 0 && link.st_uid != geteuid() &&
      link.st_uid != folder.st_uid) {
    FailToWrite(path,
                "a symbolic link of another user, in a folder that "
                "others may write to");
  }
}

}  // namespace

// One file takes another's place, and can give it back.
class OutputFiles::Replacement {
 public:
  // Throws with the old file in its place.
  Replacement(File* file, bool can_undo) : file_(*file) {
    if (can_undo) KeepOld();
    try {
      file_.temporary->Publish(file_.leaf, kNewFile);
    } catch (...) {
      // To rename one of two names of a file to the other does nothing: the
      // second name goes separately, unless it is the only one.
      if (!old_.empty() && Undo().empty()) Keep();
      throw;
    }
  }

  // Empty, or what could not be done.
  std::string Undo() const {
    if (old_.empty()) {
      unlinkat(folder(), file_.leaf.c_str(), 0);
    } else if (renameat(folder(), old_.c_str(), folder(), file_.leaf.c_str()) !=
               0) {
      return "; the old " + file_.path + " is " + old_ + " now";
    }
    return "";
  }

  void Keep() const {
    if (!old_.empty()) unlinkat(folder(), old_.c_str(), 0);
  }

 private:
  int folder() const { return file_.folder.number(); }

  // Gives the old file, if there is one, a second name.
  void KeepOld() {
    std::string name = internal::UnguessableName(TemporaryPrefix(file_.leaf));
    // Another process must not take it for abandoned.
    lock_ = Descriptor(openat(folder(), file_.leaf.c_str(),
                              O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (lock_.IsOpen()) internal::TryLock(lock_, true);
    int failed =
        linkat(folder(), file_.leaf.c_str(), folder(), name.c_str(), 0);
    if (failed != 0 && (errno == EPERM || errno == EOPNOTSUPP)) {
      // A directory by now, or a file system without hard links, where for a
      // moment there is no file of this name.
      struct stat status;
      failed =
          fstatat(folder(), file_.leaf.c_str(), &status, AT_SYMLINK_NOFOLLOW);
      if (failed == 0 && S_ISDIR(status.st_mode)) {
        failed = -1;
        errno = EISDIR;
      }
      if (failed == 0) {
        failed = renameat(folder(), file_.leaf.c_str(), folder(), name.c_str());
      }
    }
    if (failed == 0) {
      old_ = std::move(name);
    } else if (errno != ENOENT) {
      internal::ThrowErrno("link");
    }
  }

  File& file_;
  std::string old_;  // empty: there was none
  Descriptor lock_;
};

OutputFiles::~OutputFiles() {
  files_.clear();
  for (auto it = directories_.rbegin(); it != directories_.rend(); ++it) {
    rmdir(it->path.c_str());  // only if it is empty
  }
}

void OutputFiles::MakeDirectory(const std::string& path) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path at = fs::weakly_canonical(fs::absolute(path), error);
       !error && !fs::exists(at, error); at = at.parent_path()) {
    missing.push_back(at);
  }
  for (auto it = missing.rbegin(); !error && it != missing.rend(); ++it) {
    Directory made{it->string(), {AT_FDCWD, it->string()}};
    directories_.reserve(directories_.size() + 1);
    if (fs::create_directory(*it, error)) {
      made.on_signal.Confirm();
      directories_.push_back(std::move(made));
    }
  }
  if (error) FailToWrite(path, error.message());
}

void OutputFiles::Declare(const std::string& path) {
  if (path.empty()) FailToWrite("''", "expected a file name");
  std::error_code error;
  File file;
  file.path = path;
  // Behind a name in /dev or /proc there may be a file that somebody else has
  // open; it must not be replaced by another.
  const bool device = IsStandardOutput(path) || path.rfind("/dev/", 0) == 0 ||
                      path.rfind("/proc/", 0) == 0;
  if (IsStandardOutput(path)) {
    file.target = kStandardOutputDevice;
  } else if (device) {
    file.target = path;
  } else {
    RefuseForeignLink(path);
    file.target = fs::weakly_canonical(fs::absolute(path), error).string();
  }
  if (error) FailToWrite(path, error.message());
  for (const File& other : files_) {
    if (other.target == file.target) {
      FailToWrite(path, "named as two outputs of one command");
    }
  }
  const fs::path target(file.target);
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) FailToWrite(path, "it is a directory");
  if (fs::exists(status) && access(file.target.c_str(), W_OK) != 0) {
    FailToWrite(path, std::strerror(errno));
  }
  if (!device && (!fs::exists(status) || fs::is_regular_file(status))) {
    const fs::path folder = target.parent_path();
    if (!fs::is_directory(folder, error)) {
      FailToWrite(path, "there is no directory " + folder.string());
    }
    file.leaf = target.filename().string();
    const std::string prefix = TemporaryPrefix(file.leaf);
    internal::RemoveAbandoned(folder.string(), prefix);
    TryToWrite(path, [&] {
      file.folder = internal::OpenFolder(folder.string());
      file.temporary =
          std::make_unique<internal::TemporaryFile>(file.folder, prefix);
    });
  }
  files_.push_back(std::move(file));
}

std::string OutputFiles::Target(const std::string& path) const {
  const File& file = Find(path);
  return file.temporary != nullptr ? file.target : "";
}

const OutputFiles::File& OutputFiles::Find(const std::string& path) const {
  for (const File& file : files_) {
    if (file.path == path) return file;
  }
  throw std::logic_error("output file was not declared: " + path);
}

void OutputFiles::Write(const std::string& path, std::string_view content) {
  if (IsStandardOutput(path)) {
    std::cout << content << std::flush;
    if (!std::cout) FailToWrite(path, std::strerror(errno));
    return;
  }
  const File& file = Find(path);
  TryToWrite(path, [&] {
    if (file.temporary != nullptr) {
      file.temporary->Write(content);
      file.temporary->Sync();
      return;
    }
    const Descriptor device(
        open(path.c_str(), O_WRONLY | O_TRUNC | O_NOCTTY | O_CLOEXEC));
    if (!device.IsOpen()) internal::ThrowErrno("open");
    internal::WriteAll(device, content);
  });
}

void OutputFiles::Commit() {
  std::vector<File*> replaced;
  for (File& file : files_) {
    if (file.temporary != nullptr) replaced.push_back(&file);
  }
  {
    const internal::SignalsWait none_between;
    std::vector<Replacement> done;
    done.reserve(replaced.size());
    try {
      for (File* const file : replaced) {
        done.emplace_back(file, file != replaced.back());
      }
    } catch (const std::exception& error) {
      const std::string& path = replaced[done.size()]->path;
      std::string lost;
      for (auto it = done.rbegin(); it != done.rend(); ++it) lost += it->Undo();
      const auto* const system = dynamic_cast<const std::system_error*>(&error);
      if (system == nullptr) throw;
      FailToWrite(path, system->code().message() + lost);
    }
    for (const Replacement& replacement : done) replacement.Keep();
  }
  for (const File* const file : replaced) {
    // So that a power cut does not bring the old names back; some file systems
    // cannot, and then nothing is lost but that.
    const Descriptor folder(
        openat(file->folder.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.IsOpen()) fsync(folder.number());
  }
  files_.clear();
  directories_.clear();
}

bool OutputFiles::UseStandardOutput() const {
  for (const File& file : files_) {
    if (IsStandardOutput(file.path)) return true;
  }
  return false;
}

}  // namespace phongpd
