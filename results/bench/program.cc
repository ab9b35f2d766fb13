// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/program.h"

#include <exception>
#include <iostream>

namespace phongpd::bench {

int RunProgram(const std::string& name, int (*run)(int argc, char** argv),
               int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return 3;
  }
}

}  // namespace phongpd::bench
