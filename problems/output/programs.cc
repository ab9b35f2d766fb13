// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/programs.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

namespace phongpd {

std::string FindProgram(const std::vector<std::string>& names) {
  const char* const path = std::getenv("PATH");
  for (const std::string& name : names) {
    std::istringstream folders(path != nullptr ? path : "/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
      const std::string program = folder + "/" + name;
      if (access(program.c_str(), X_OK) == 0) return program;
    }
  }
  return "";
}

}  // namespace phongpd
