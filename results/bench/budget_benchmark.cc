// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: which flags of plan and optimize answer within a budget of processor
// seconds, builds included, by the number of triangles.  Writes the rows of
// which budget_report.py makes the table that --budget picks by.  Pairs whose
// rows are there are not measured again: delete budget.csv and
// budget_measured.txt to begin anew.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "planners/ompl/ompl_planning.h"
#include "results/bench/budget_measure.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

std::string TextOf(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Rows of this pair are there already.
bool IsKnown(const std::string& csv, const BudgetCase& pair) {
  return csv.find("," + pair.family + "," + std::to_string(pair.decade) +
                  ",") != std::string::npos;
}

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput("Flags within budgets: rows.");
  std::size_t least = 1000, most = 1000000;
  BudgetOptions options;
  app.add_option("--seed", options.seed)->capture_default_str();
  app.add_option("--seeds", options.seeds, "Problems of each pair")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--least", least, "Of decades of triangles, from this one")
      ->capture_default_str();
  app.add_option("--most", most, "... to this one")->capture_default_str();
  program->Parse();
  SilenceOmpl();
  options.cache = program->folder() + "/budget_cache";
  std::filesystem::remove_all(options.cache);
  // It goes on where it was cut off.
  std::string csv = TextOf(program->folder() + "/budget.csv");
  std::string measured = TextOf(program->folder() + "/budget_measured.txt");
  measured += program->Circumstances(options.seed) + "\n";
  for (const BudgetCase& pair : BudgetCases()) {
    if (pair.decade < least || pair.decade > most) continue;
    if (IsKnown(csv, pair)) {
      std::cout << pair.family << ", " << pair.decade
                << " triangles: kept as it was measured before" << std::endl;
      continue;
    }
    const std::vector<BudgetRow> added = MeasureBudget(pair, options);
    const NamedTable table = BudgetTable(added);
    std::cout << ToText(table.table) << std::endl;
    // As soon as they are known: the last pairs take longest.
    const std::string text = ToCsv(table.table);
    csv += csv.empty() ? text : text.substr(text.find('\n') + 1);
    program->Write(table.file, csv);
    program->Write("budget_measured.txt", measured);
    program->Commit();
    std::filesystem::remove_all(options.cache);
  }
  return 0;
}

}  // namespace phongpd::bench
