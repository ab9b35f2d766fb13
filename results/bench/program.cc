// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/program.h"

#include <exception>
#include <iostream>

namespace phongpd::bench {

void WriteReport(const std::vector<NamedTable>& tables,
                 const std::vector<Figure>& figures, const std::string& readme,
                 OutputDirectory* out) {
  for (const NamedTable& named : tables) {
    out->Write(named.file, ToCsv(named.table));
  }
  for (const Figure& figure : figures) out->Write(figure.file, figure.svg);
  const Pages pages = SplitReadme(readme);
  out->Write("README.md", pages.readme);
  if (!pages.tables.empty()) out->Write("tables.md", pages.tables);
}

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
