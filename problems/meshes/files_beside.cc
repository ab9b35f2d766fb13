// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/files_beside.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/mesh/input_file.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using internal::Descriptor;

// Opens from the folder down.  A closed one, with errno, if that cannot be.
Descriptor OpenWithoutLinks(const Descriptor& folder, const fs::path& name,
                            int last_flags) {
  Descriptor at(openat(folder.number(), ".", O_PATH | O_DIRECTORY | O_CLOEXEC));
  for (auto part = name.begin(); part != name.end() && at.IsOpen();) {
    const std::string one = *part++;
    if (one == ".." || one == "/") {
      errno = EXDEV;
      return Descriptor();
    }
    if (one.empty()) continue;  // of a slash at the end
    const int flags = part == name.end() ? last_flags : O_PATH | O_DIRECTORY;
    at = Descriptor(
        openat(at.number(), one.c_str(), flags | O_NOFOLLOW | O_CLOEXEC));
  }
  return at;
}

[[noreturn]] void RefuseRoot(const std::string& root) {
  throw InputError(root +
                   ": expected the root folder of mesh files, found none");
}

Descriptor OpenRoot(const std::string& root) {
  Descriptor folder(open(root.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (!folder.IsOpen()) RefuseRoot(root);
  return folder;
}

std::string Reason(int error) {
  switch (error) {
    case ENOENT:
      return "nothing; check the path";
    case ENOTDIR:
      return "a link or a file where a folder should be; name a path without";
    case ELOOP:
      return "a link; name the file itself";
    case EXDEV:
      return "a path that leads elsewhere; name a file beside or below";
    case ENXIO:
      return "a device or socket; name a file";
    default:
      return std::string("one that cannot be opened (") + std::strerror(error) +
             "); check its permissions";
  }
}

std::string BelowRoot(const std::string& root) {
  return " below the root " + root;
}

fs::path RequiredBelow(const std::string& path, const std::string& root) {
  std::optional<fs::path> below = PathBelow(path, root);
  if (below) return *std::move(below);
  throw InputError(path + ": expected a file" + BelowRoot(root) +
                   ", found one elsewhere; move it there");
}

std::string ReadRegular(const Descriptor& folder, const fs::path& name,
                        const std::string& file, const std::string& kind,
                        std::uintmax_t max_bytes) {
  const auto refuse = [&](const std::string& found) {
    throw InputError(file + ": expected " + kind + ", found " + found);
  };
  // A pipe is not waited for, a terminal stays as it is.
  const Descriptor opened =
      OpenWithoutLinks(folder, name, O_RDONLY | O_NONBLOCK | O_NOCTTY);
  if (!opened.IsOpen()) refuse(Reason(errno));
  struct stat status = {};
  if (fstat(opened.number(), &status) != 0) refuse(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) refuse("a directory; name a file in it");
  if (S_ISFIFO(status.st_mode)) refuse("a pipe; name a file");
  if (!S_ISREG(status.st_mode)) refuse("a device; name a file");
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size > max_bytes) {
    refuse(std::to_string(size) + " bytes, of " + std::to_string(max_bytes) +
           " allowed; make it smaller");
  }
  try {
    return internal::ReadAll(opened);
  } catch (const std::system_error& error) {
    refuse(std::string("one that cannot be read (") + error.what() + ")");
  }
  return "";
}

}  // namespace

std::optional<fs::path> PathBelow(const std::string& path,
                                  const std::string& root) {
  std::error_code error;
  const fs::path folder = fs::canonical(root, error);
  if (error || !fs::is_directory(folder, error)) RefuseRoot(root);
  const fs::path resolved = fs::weakly_canonical(path, error);
  if (error) return std::nullopt;
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(),
                                         resolved.begin(), resolved.end());
  if (end != folder.end()) return std::nullopt;
  fs::path below;
  for (auto part = rest; part != resolved.end(); ++part) below /= *part;
  return below;
}

FilesBeside::FilesBeside(const std::string& path, const std::string& root)
    : root_(root) {
  const fs::path parent = fs::path(path).parent_path();
  if (root.empty()) {
    folder_ = OpenRoot(parent.empty() ? "." : parent.string());
    return;
  }
  folder_ =
      OpenWithoutLinks(OpenRoot(root), RequiredBelow(path, root).parent_path(),
                       O_PATH | O_DIRECTORY);
  if (!folder_.IsOpen()) {
    throw InputError(path + ": expected a file" + BelowRoot(root) + ", found " +
                     Reason(errno));
  }
}

std::string FilesBeside::Read(const fs::path& name, const std::string& file,
                              const std::string& kind,
                              std::uintmax_t max_bytes) const {
  return ReadRegular(folder_, name, file,
                     root_.empty() ? kind : kind + ',' + BelowRoot(root_),
                     max_bytes);
}

std::string ReadMeshFile(const std::string& path, const std::string& root,
                         const char* kind, std::uintmax_t max_bytes) {
  if (root.empty()) return ReadInputFile(path, kind, max_bytes);
  return ReadRegular(OpenRoot(root), RequiredBelow(path, root), path, kind,
                     max_bytes);
}

}  // namespace phongpd
