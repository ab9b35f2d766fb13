// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "core/mesh/mesh_error.h"

namespace phongpd {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string name =
      ((error ? fs::path("/tmp") : parent) / "phongpd-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw InputError(name + ": cannot make a temporary folder (" +
                     std::strerror(errno) + ")");
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace phongpd
