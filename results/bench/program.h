// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "results/bench/output_directory.h"
#include "results/bench/report.h"

// The frame of every benchmark program.
namespace phongpd::bench {

// Writes the rows of all tables, all figures and README.md, with tables.md
// beside it where they are long.
void WriteReport(const std::vector<NamedTable>& tables,
                 const std::vector<Figure>& figures, const std::string& readme,
                 OutputDirectory* out);

// Runs the program; an exception becomes one line on stderr, "name: why", and
// exit code 3.
int RunProgram(const std::string& name, int (*run)(int argc, char** argv),
               int argc, char** argv);

}  // namespace phongpd::bench
