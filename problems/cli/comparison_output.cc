// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/comparison_output.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "problems/output/text.h"
#include "problems/studies/performance_profile.h"
#include "problems/studies/trajectory_comparison.h"

namespace phongpd::cli {
namespace {

std::string CellTable(const std::vector<ComparisonCell>& cells) {
  TextStream text;
  text << "scene, protocol, method: solved of runs (stalled) + free not "
          "solved, claims but collides; median iterations, restoration "
          "%\n";
  for (const ComparisonCell& c : cells) {
    text << c.scene << ", " << c.protocol << ", " << c.method << ": "
         << c.solved << " of " << c.runs << " (" << c.stalled << ") + "
         << c.free_only << ", " << c.claims_only << "; "
         << Rounded(c.median_iterations, 4) << ", "
         << Rounded(100.0 * c.restoration_share, 2) << '\n';
  }
  return text.str();
}

}  // namespace

std::string SummaryTable(const std::vector<nlohmann::ordered_json>& rows) {
  return CellTable(Summarize(rows));
}

std::string WriteSummaries(const std::vector<nlohmann::ordered_json>& rows,
                           const std::string& directory, OutputFiles* outputs) {
  const std::vector<ComparisonCell> cells = Summarize(rows);
  const auto write = [&](const std::string& name, const std::string& text) {
    const std::string path = directory + "/" + name;
    outputs->Declare(path);
    outputs->Write(path, text);
  };
  write("summary.csv", ComparisonCsv(cells));
  write("rows.csv", CompactCsv(rows));
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    const bool is_there = std::any_of(
        cells.begin(), cells.end(),
        [&](const ComparisonCell& c) { return c.protocol == protocol.name; });
    if (!is_there) continue;
    const std::pair<const char*, const char*> measures[] = {
        {"iterations", "iterations"},
        {"jacobians", "evaluations/jacobian"},
        {"seconds", "seconds/total"}};
    for (const auto& [name, measure] : measures) {
      write("profile-" + protocol.name + "-" + name + ".svg",
            PerformanceProfile(rows, protocol.name, measure));
    }
  }
  return CellTable(cells);
}

}  // namespace phongpd::cli
