// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/trade_defaults.h"

#include "results/bench/csv_table.h"

namespace phongpd::bench {
namespace {

bool IsLoss(const std::string& verdict) {
  return verdict.find("loss") != std::string::npos;
}

}  // namespace

std::string DefaultSentences(const std::string& results) {
  const CsvTable rows = ReadCsvTable(results + "/trade/defaults.csv");
  std::string text =
      "\nDefaults against challengers on the scenes of the studies, paired "
      "([defaults.md](defaults.md)):\n\n";
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    const std::string& time = rows.Text(i, "time is a");
    const std::string& measure = rows.Text(i, "length or energy is a");
    const bool is_worse = IsLoss(time) || IsLoss(measure);
    const bool is_better = time == "win" || measure == "win";
    text += "- " + rows.Text(i, "consumer") + ", " +
            rows.Text(i, "challenger") + " instead of " +
            rows.Text(i, "default") + ": time " + rows.Text(i, "time") + " (" +
            time + "), length or energy " + rows.Text(i, "length or energy") +
            " (" + measure + "), exactly free " + rows.Text(i, "exactly free") +
            " of " + rows.Text(i, "instances") + ": " +
            (is_worse    ? "the default is right"
             : is_better ? "no worse in either and better in one"
                         : "it does not matter") +
            ".\n";
  }
  return text +
         "\nDecided: the planner's spacing stays; so little time, and no "
         "length, "
         "is no reason to change every published path. Of rows the optimiser "
         "takes one a sample from free starts, too, where it took three until "
         "this table spoke for one. The second start stays as well: no path is "
         "longer for it, and who wants the time takes `--preset fast`.\n";
}

}  // namespace phongpd::bench
