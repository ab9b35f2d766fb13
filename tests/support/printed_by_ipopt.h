// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "planners/trajectory/ipopt_solve.h"

namespace phongpd::testing {

// Solves, and returns what Ipopt printed.
inline std::string PrintedByIpopt(NonlinearProgram* program,
                                  const Eigen::VectorXd& start,
                                  IpoptSettings settings, IpoptRun* run) {
  std::string folder =
      (std::filesystem::temp_directory_path() / "phongpd_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    ADD_FAILURE() << "no temporary folder " << folder;
    return "";
  }
  const std::string path = folder + "/ipopt.txt";
  settings.print_file = path;
  *run = SolveWithIpopt(program, start, settings);
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::filesystem::remove_all(folder);
  return text.str();
}

}  // namespace phongpd::testing
