// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "results/bench/convergence_report.h"

namespace phongpd::bench {
namespace {

using Json = nlohmann::ordered_json;
using Cells = std::vector<ComparisonCell>;

// Start repair on contact spaces of about ten thousand triangles.
std::string RepairLine(const std::vector<Json>& rows) {
  std::vector<double> seconds;
  for (const Json& row : rows) {
    const long triangles = row.at("contact_triangles").get<long>();
    if (row.at("protocol") == "pipeline" && row.at("method") == kPreset &&
        triangles >= 5000 && triangles <= 20000) {
      seconds.push_back(row.at("seconds").at("repair").get<double>());
    }
  }
  if (seconds.empty()) return "";
  const double median = Quantile(seconds, 0.5);
  return "- pipeline, start repair on 5 to 20 thousand triangles, median ≤ 20 "
         "ms: " +
         Rounded(1e3 * median) + " ms, longest " +
         Rounded(1e3 * Quantile(seconds, 1.0)) + " ms" +
         (median <= 0.02 ? " – met.\n" : " – **missed**.\n");
}

}  // namespace

std::string WonAndLost(const ConvergenceResults& results) {
  return "## Won and lost\n\n" + DuelLines(results) + '\n';
}

std::string Findings(const ConvergenceResults& results) {
  const Cells& cells = results.cells;
  std::string text = "## Targets\n\n";
  const auto line = [&](const std::string& what, const std::string& found,
                        bool is_met) {
    text += "- " + what + ": " + found +
            (is_met ? " – met.\n" : " – **missed**.\n");
  };
  for (const char* protocol : {"straight-monotone", "straight-adaptive"}) {
    for (const char* prefix : {"u_axis", "plate:thickness=0.1",
                               "plate:thickness=0.02", "long_plate"}) {
      for (const ComparisonCell& c : cells) {
        if (c.protocol != protocol || c.method != kPreset ||
            c.scene.compare(0, std::string(prefix).size(), prefix) != 0) {
          continue;
        }
        const ComparisonCell* euclid =
            Find(cells, c.scene, protocol, "euclidean");
        line(std::string(protocol) + ", " + c.scene + ", Phong ℓ = 0.2 ≥ 95 %",
             SolvedText(c) + (euclid == nullptr
                                  ? ""
                                  : " (Euclid " + SolvedText(*euclid) + ")"),
             20 * c.solved >= 19 * c.runs);
      }
    }
  }
  for (const char* scene : {"u_axis", "u_trap", "l"}) {
    const ComparisonCell* phong =
        Find(cells, scene, "straight-monotone", kPreset);
    const ComparisonCell* euclid =
        Find(cells, scene, "straight-monotone", "euclidean");
    if (phong == nullptr || euclid == nullptr) continue;
    line(std::string("straight-monotone, ") + scene +
             ", median iterations ≤ 1/3 of Euclid's",
         Rounded(phong->median_iterations, 4) + " against " +
             Rounded(euclid->median_iterations, 4),
         3.0 * phong->median_iterations <= euclid->median_iterations);
  }
  // Those that meet a target are counted, the others named.
  const std::pair<const char*, bool (*)(const ComparisonCell&)> targets[] = {
      {"exactly free ≥ 99 %",
       [](const ComparisonCell& c) {
         return 100 * (c.solved + c.free_only) >= 99 * c.runs;
       }},
      {"converged ≥ 95 %",
       [](const ComparisonCell& c) { return 20 * c.solved >= 19 * c.runs; }},
      {"within 2 % of the best ≥ 90 %",
       [](const ComparisonCell& c) {
         return 10 * c.within_2_percent >= 9 * c.runs;
       }},
      {"callbacks ≤ 25 % of the time",
       [](const ComparisonCell& c) { return c.callback_share <= 0.25; }},
  };
  for (const auto& [target, is_met] : targets) {
    int met = 0, all = 0;
    std::string others;
    for (const ComparisonCell& c : cells) {
      if (c.protocol != "pipeline" || c.method != kPreset) continue;
      ++all;
      if (is_met(c)) {
        ++met;
        continue;
      }
      others += (others.empty() ? "; not " : ", ") + c.scene;
    }
    if (all == 0) continue;
    line(std::string("pipeline, ") + target,
         Shown(met) + " of " + Shown(all) + " scenes" + others, met == all);
  }
  text += RepairLine(results.rows);
  const bool has_claims =
      std::any_of(cells.begin(), cells.end(), [](const ComparisonCell& c) {
        return c.protocol == "pipeline" && c.claims_only > 0;
      });
  line(
      "pipeline, Ipopt claims a solution that collides (the pipeline never "
      "returns it)",
      has_claims ? "some" : "none", !has_claims);
  return text + '\n' + WonAndLost(results) +
         "Which part of PhongPD it is that helps, its memory, depth or "
         "direction, and each scene by itself: "
         "[what-helps.csv](what-helps.csv), [verdicts.csv](verdicts.csv), "
         "[losses.csv](losses.csv).\n";
}

}  // namespace phongpd::bench
