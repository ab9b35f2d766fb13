// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "problems/output/text.h"
#include "results/bench/convergence_report.h"

namespace phongpd::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kRival[] = "euclidean";
constexpr double kTie = 0.05;  // of the seeds

// The runs of both metrics on one seed; null if there was none.
struct Duel {
  const Json* phong = nullptr;
  const Json* euclid = nullptr;

  bool IsWonBy(const Json* Duel::*one, const Json* Duel::*other) const {
    const auto is_solved = [](const Json* row) {
      return row != nullptr && row->at("solved").get<bool>();
    };
    return is_solved(this->*one) && !is_solved(this->*other);
  }
};

// By scene and seed, of one protocol.
using Duels = std::map<std::string, std::map<long, Duel>>;

Duels FindDuels(const std::vector<Json>& rows, const std::string& protocol) {
  Duels duels;
  for (const Json& row : rows) {
    if (row.at("protocol") != protocol) continue;
    Duel& duel =
        duels[row.at("scene").get<std::string>()][row.at("seed").get<long>()];
    if (row.at("method") == kPreset) duel.phong = &row;
    if (row.at("method") == kRival) duel.euclid = &row;
  }
  return duels;
}

// Calls visit(Phong's cell, its duels by seed, seeds only Phong solved, seeds
// only Euclid solved) for every scene and protocol in which both metrics ran.
template <typename Visit>
void ForEachPair(const ConvergenceResults& results, const Visit& visit) {
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    if (!protocol.uses_every_metric) continue;
    const Duels duels = FindDuels(results.rows, protocol.name);
    for (const ComparisonCell& c : results.cells) {
      if (c.protocol != protocol.name || c.method != kPreset ||
          Find(results.cells, c.scene, c.protocol, kRival) == nullptr) {
        continue;
      }
      int phong = 0, euclid = 0;
      for (const auto& [seed, duel] : duels.at(c.scene)) {
        phong += duel.IsWonBy(&Duel::phong, &Duel::euclid);
        euclid += duel.IsWonBy(&Duel::euclid, &Duel::phong);
      }
      visit(c, duels.at(c.scene), phong, euclid);
    }
  }
}

double Share(int phong, int euclid, const ComparisonCell& cell) {
  return static_cast<double>(phong - euclid) / static_cast<double>(cell.runs);
}

double Number(const Json* row, const char* key) {
  return row->at(Json::json_pointer(key)).get<double>();
}

}  // namespace

Table VerdictTable(const ConvergenceResults& results) {
  Table table{"PhongPD (ℓ = 0.2) against Euclidean PD, paired by seed",
              "Seeds that only one of the two solved. Win or loss: more than "
              "5 % of the seeds apart; tie otherwise.",
              {"scene", "protocol", "only Phong", "only Euclid", "verdict"},
              {}};
  ForEachPair(results, [&](const ComparisonCell& cell, const auto&, int phong,
                           int euclid) {
    const double apart = Share(phong, euclid, cell);
    table.rows.push_back({cell.scene, cell.protocol, Shown(phong),
                          Shown(euclid),
                          apart > kTie    ? "win"
                          : apart < -kTie ? "**loss**"
                                          : "tie"});
  });
  return table;
}

Table LossTable(const ConvergenceResults& results) {
  Table table{
      "Where Euclidean PD solves more, and why",
      "The seeds that only Euclidean PD solved. Exactly free: PhongPD ended "
      "free all the same, but unconverged. Branch ends: of PhongPD, median; "
      "inside a solid its continuous branches end, and where a path dips into "
      "the walls on both sides of a channel again and again each end is a jump "
      "like Euclid's. Restoration: share of the iterations, PhongPD and "
      "Euclid. "
      "Objective: PhongPD's over Euclid's, median; below 1 the unconverged "
      "path "
      "goes the shorter way.",
      {"scene", "protocol", "lost", "exactly free", "branch ends",
       "restoration", "objective"},
      {}};
  ForEachPair(results, [&](const ComparisonCell& cell, const auto& duels,
                           int phong, int euclid) {
    if (Share(phong, euclid, cell) >= -kTie) return;
    int free = 0;
    std::vector<double> ends, ratios;
    double all[2] = {0.0, 0.0}, restoring[2] = {0.0, 0.0};
    for (const auto& [seed, duel] : duels) {
      if (!duel.IsWonBy(&Duel::euclid, &Duel::phong)) continue;
      free += duel.phong->at("collision_free").template get<bool>();
      ends.push_back(Number(duel.phong, "/queries/branch_ends"));
      ratios.push_back(Number(duel.phong, "/objective") /
                       Number(duel.euclid, "/objective"));
      for (const int k : {0, 1}) {
        const Json* row = k == 0 ? duel.phong : duel.euclid;
        all[k] += Number(row, "/iterations");
        restoring[k] += Number(row, "/restoration_iterations");
      }
    }
    const auto percent = [&](int k) {
      return Rounded(100.0 * restoring[k] / std::max(1.0, all[k]), 2) + " %";
    };
    table.rows.push_back({cell.scene, cell.protocol, Shown(euclid), Shown(free),
                          Rounded(Quantile(ends, 0.5)),
                          percent(0) + ", " + percent(1),
                          Rounded(Quantile(ratios, 0.5))});
  });
  return table;
}

}  // namespace phongpd::bench
