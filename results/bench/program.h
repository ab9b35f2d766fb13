// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "results/bench/output_directory.h"
#include "results/bench/report.h"

// The frame of every benchmark program.
namespace phongpd::bench {

// Runs the program; an exception becomes one line on stderr, "name: why", and
// exit code 3.
int RunProgram(const std::string& name, int (*run)(int argc, char** argv),
               int argc, char** argv);

}  // namespace phongpd::bench
