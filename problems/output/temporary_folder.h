// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace phongpd {

// An empty folder of the caller's own (mode 0700) among the system's temporary
// ones, under a name nobody can guess; gone with all it holds when this is.
class TemporaryFolder {
 public:
  // Throws InputError naming it.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace phongpd
