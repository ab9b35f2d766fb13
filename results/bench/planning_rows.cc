// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/planning_rows.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace phongpd::bench {
namespace {

// Least length of a path known for a scene.
std::map<std::string, double> BestLengths(const PlanningResults& results) {
  std::map<std::string, double> best;
  const auto offer = [&best](const std::string& scene, double length) {
    const auto [it, is_new] = best.emplace(scene, length);
    if (!is_new) it->second = std::min(it->second, length);
  };
  for (const ExactRow& row : results.exact) {
    if (row.status == "solved") offer(row.problem.scene, row.length);
    if (row.witness_length > 0.0) offer(row.problem.scene, row.witness_length);
  }
  for (const auto* rows : {&results.samplers, &results.narrowing}) {
    for (const SamplerRow& row : *rows) {
      for (const SamplerRun& run : row.runs) {
        if (run.is_solved) offer(row.problem.scene, run.length);
      }
    }
  }
  return best;
}

}  // namespace

Table ExactTable(const PlanningResults& results) {
  const std::map<std::string, double> best = BestLengths(results);
  return MakeTable(
      {"scene", "triangles", "answer", "right", "query ms", "tables ms",
       "contact space ms", "clearance/δ", "length", "ratio"},
      results.exact, [&](const ExactRow& r, const auto& add) {
        const bool has_path = r.status == "solved";
        add(r.problem.scene, r.triangles, r.status,
            std::string(r.is_right ? "yes" : "**no**"), Rounded(r.milliseconds),
            Rounded(r.build_milliseconds),
            Rounded(r.contact_space_milliseconds),
            has_path ? Rounded(r.clearance / r.problem.delta) : "–",
            has_path ? Rounded(r.length, 4) : "–",
            has_path ? Rounded(r.length / best.at(r.problem.scene), 4) : "–");
      });
}

Table MotionTable(const PlanningResults& results) {
  return MakeTable({"scene", "triangles", "median µs", "95 % µs", "blocked"},
                   results.motions, [](const MotionRow& r, const auto& add) {
                     add(r.scene, r.triangles, r.median_microseconds,
                         r.slow_microseconds,
                         Rounded(100.0 * r.blocked_share) + " %");
                   });
}

std::string RunsCsv(const PlanningResults& results) {
  std::ostringstream csv;
  csv << "scene,planner,run,solved,seconds,samples,samples_to_passage,"
         "collision_checks,segment_checks,retractions,length,clearance,false_"
         "claim\n";
  for (const auto* rows : {&results.samplers, &results.narrowing}) {
    for (const SamplerRow& row : *rows) {
      for (std::size_t i = 0; i < row.runs.size(); ++i) {
        const SamplerRun& r = row.runs[i];
        csv << '"' << row.problem.scene << "\"," << row.planner << ',' << i + 1
            << ',' << r.is_solved << ',' << Rounded(r.seconds, 4) << ','
            << r.samples << ',' << r.samples_to_passage << ','
            << r.collision_checks << ',' << r.segment_checks << ','
            << r.retractions << ',' << Rounded(r.length, 6) << ','
            << Rounded(r.clearance, 4) << ',' << r.is_false << '\n';
      }
    }
  }
  return csv.str();
}

}  // namespace phongpd::bench
