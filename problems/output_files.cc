// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output_files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <system_error>

namespace phongpd {
namespace fs = std::filesystem;

namespace {

constexpr const char* kStandardOutput = "/dev/stdout";

[[noreturn]] void FailToWrite(const std::string& path,
                              const std::string& reason) {
  throw InputError(path + ": cannot be written (" + reason + ")");
}

}  // namespace

OutputFiles::~OutputFiles() {
  for (const File& file : files_) {
    std::error_code ignored;
    if (file.temporary != file.target) fs::remove(file.temporary, ignored);
  }
  for (auto it = directories_.rbegin(); it != directories_.rend(); ++it) {
    std::error_code ignored;
    fs::remove(*it, ignored);  // only if it is empty
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
    if (fs::create_directory(*it, error)) directories_.push_back(it->string());
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
  const bool device =
      path.rfind("/dev/", 0) == 0 || path.rfind("/proc/", 0) == 0;
  file.target =
      device ? path : fs::weakly_canonical(fs::absolute(path), error).string();
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
  if (device || (fs::exists(status) && !fs::is_regular_file(status))) {
    file.temporary = file.target;
  } else {
    const fs::path folder = target.parent_path();
    if (!fs::is_directory(folder, error)) {
      FailToWrite(path, "there is no directory " + folder.string());
    }
    if (access(folder.c_str(), W_OK) != 0) {
      FailToWrite(path, std::strerror(errno));
    }
    const std::string name = "." + target.stem().string() + "." +
                             std::to_string(getpid()) + ".part" +
                             target.extension().string();
    file.temporary = (folder / name).string();
  }
  files_.push_back(file);
}

const OutputFiles::File& OutputFiles::Find(const std::string& path) const {
  for (const File& file : files_) {
    if (file.path == path) return file;
  }
  throw std::logic_error("output file was not declared: " + path);
}

const std::string& OutputFiles::TemporaryPath(const std::string& path) const {
  return Find(path).temporary;
}

void OutputFiles::Write(const std::string& path, const std::string& content) {
  if (path == kStandardOutput) {
    std::cout << content << std::flush;
    if (!std::cout) FailToWrite(path, std::strerror(errno));
    return;
  }
  std::ofstream stream(Find(path).temporary, std::ios::binary);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) FailToWrite(path, std::strerror(errno));
}

void OutputFiles::Commit() {
  for (const File& file : files_) {
    if (file.temporary == file.target) continue;
    std::error_code error;
    fs::rename(file.temporary, file.target, error);
    if (error) FailToWrite(file.path, error.message());
  }
  files_.clear();
  directories_.clear();
}

bool OutputFiles::UseStandardOutput() const {
  for (const File& file : files_) {
    if (file.path == kStandardOutput) return true;
  }
  return false;
}

}  // namespace phongpd
