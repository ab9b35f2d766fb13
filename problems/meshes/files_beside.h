// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "files/descriptor.h"

// Files that other files name.  They are opened by descriptors from a folder
// down, one component after the other and through no link: what has been
// checked is what is read, also where somebody changes the folder meanwhile.
namespace phongpd {

// `path` with links and ".." followed, relative to the folder `root`; none if
// it does not lie below.  Throws InputError if `root` is no folder.
std::optional<std::filesystem::path> PathBelow(const std::string& path,
                                               const std::string& root);

// A folder, and the files that lie in it or below.
class FilesBeside {
 public:
  // The folder of the file `path`, which must lie below `root` unless that is
  // empty.  Throws InputError.
  FilesBeside(const std::string& path, const std::string& root);

  // The bytes of a regular file; never waits.  `name` is relative, without
  // "..".  Throws InputError "FILE: expected KIND, found ..." where FILE is how
  // a message calls it, and KIND is followed by the root where there is one:
  // for nothing, links, devices, pipes, folders, and more than `max_bytes`
  // bytes.
  std::string Read(const std::filesystem::path& name, const std::string& file,
                   const std::string& kind, std::uintmax_t max_bytes) const;

 private:
  std::string root_;
  internal::Descriptor folder_;
};

// The bytes of a mesh file that a person or, with a `root`, a stranger's scene
// names: by ReadInputFile, or a regular file below the root.  Throws
// InputError.
std::string ReadMeshFile(const std::string& path, const std::string& root,
                         const char* kind, std::uintmax_t max_bytes);

}  // namespace phongpd
