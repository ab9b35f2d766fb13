// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "problems/output/text.h"
#include "results/bench/convergence_duels.h"
#include "results/bench/convergence_report.h"

namespace phongpd::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kRival[] = "euclidean";
constexpr char kDirected[] = "mixed@0.2";
constexpr char kFaded[] = "faded@0.2";
constexpr char kMany[] = "all";

struct Match {
  std::string where, protocol, own, rival;
  Duel duel;
};

std::vector<std::string> ScenesOf(const ConvergenceResults& results) {
  std::vector<std::string> scenes;
  for (const ComparisonCell& c : results.cells) {
    if (std::find(scenes.begin(), scenes.end(), c.scene) == scenes.end()) {
      scenes.push_back(c.scene);
    }
  }
  return scenes;
}

void Judge(std::vector<Match>* matches) {
  std::vector<Duel*> duels;
  for (Match& match : *matches) duels.push_back(&match.duel);
  Correct(duels);
}

std::string Ratio(int a, int b) { return Shown(a) + " : " + Shown(b); }

constexpr char kTests[] =
    "Solved alone: seeds that one of the two alone solved, and the difference "
    "of the solved shares in points with its 95 % interval. Fewer iterations: "
    "seeds on which either took fewer (a run that is not solved took more than "
    "any), and the median of own over the rival's where both solved, with its "
    "95 % interval. p: two-sided sign test after Holm's correction over all "
    "tests of the table; win or loss below 0.05, else tie.";

// A table with columns for the labels of a match and for its tests.
Table EmptyTestTable(const std::string& title, const std::string& note,
                     std::vector<std::string> labels) {
  for (const char* column : {"solved alone", "points", "p of that", "solved",
                             "fewer iterations", "ratio", "p", "iterations"}) {
    labels.emplace_back(column);
  }
  return {title, note + kTests, std::move(labels), {}};
}

void AppendTests(const Duel& duel, std::vector<std::string>* row) {
  const std::vector<std::string> cells = {Ratio(duel.only_own, duel.only_rival),
                                          duel.SolvedEffect(),
                                          Rounded(duel.p_solved, 2),
                                          duel.SolvedVerdict(),
                                          Ratio(duel.fewer, duel.more),
                                          duel.IterationsEffect(),
                                          Rounded(duel.p_iterations, 2),
                                          duel.IterationsVerdict()};
  row->insert(row->end(), cells.begin(), cells.end());
}

// The preset against Euclid, scene by scene.
std::vector<Match> SceneMatches(const ConvergenceResults& results) {
  const Arena arena(results.rows);
  std::vector<Match> matches;
  for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
    for (const std::string& scene : ScenesOf(results)) {
      Match match{scene, protocol.name, kPreset, kRival,
                  arena.Fight(protocol.name, kPreset, kRival, {scene})};
      if (match.duel.problems > 0) matches.push_back(std::move(match));
    }
  }
  Judge(&matches);
  return matches;
}

std::vector<Match> GroupMatches(const ConvergenceResults& results) {
  const Arena arena(results.rows);
  const std::pair<const char*, const char*> pairs[] = {
      {kPreset, kRival}, {"followed", kRival},  {kDirected, kRival},
      {kFaded, kRival},  {kPreset, "followed"}, {kDirected, kPreset},
      {kFaded, kPreset}, {kFaded, kDirected},
  };
  const std::vector<std::string> all = ScenesOf(results);
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  groups.emplace_back(kMany, all);
  for (const SceneGroup& group : SceneGroups()) {
    groups.emplace_back(group.name, std::vector<std::string>());
    for (const std::string& scene : all) {
      if (Belongs(scene, group)) groups.back().second.push_back(scene);
    }
  }
  std::vector<Match> matches;
  for (const auto& [own, rival] : pairs) {
    for (const TrajectoryProtocol& protocol : TrajectoryProtocols()) {
      for (const auto& [name, scenes] : groups) {
        Match match{name, protocol.name, own, rival,
                    arena.Fight(protocol.name, own, rival, scenes)};
        if (match.duel.problems > 0) matches.push_back(std::move(match));
      }
    }
  }
  Judge(&matches);
  return matches;
}

double Number(const Json* row, const char* key) {
  return row->at(Json::json_pointer(key)).get<double>();
}

// The runs of the preset and of Euclid on the seeds of a cell that Euclid
// alone solved.
std::vector<std::pair<const Json*, const Json*>> LostRuns(
    const ConvergenceResults& results, const Match& match) {
  std::map<long, std::map<std::string, const Json*>> runs;
  for (const Json& row : results.rows) {
    if (row.at("protocol") != match.protocol || row.at("scene") != match.where)
      continue;
    runs[row.at("seed").get<long>()][RowText(row, "method")] = &row;
  }
  std::vector<std::pair<const Json*, const Json*>> lost;
  for (auto& [seed, methods] : runs) {
    const Json* own = methods[kPreset];
    const Json* rival = methods[kRival];
    if (own == nullptr || rival == nullptr) continue;
    if (!own->at("solved").get<bool>() && rival->at("solved").get<bool>()) {
      lost.emplace_back(own, rival);
    }
  }
  return lost;
}

}  // namespace

Table VerdictTable(const ConvergenceResults& results) {
  Table table =
      EmptyTestTable("PhongPD (ℓ = 0.2) against Euclidean PD, paired by seed",
                     "", {"scene", "protocol"});
  for (const Match& match : SceneMatches(results)) {
    table.rows.push_back({match.where, match.protocol});
    AppendTests(match.duel, &table.rows.back());
  }
  return table;
}

Table WhatHelpsTable(const ConvergenceResults& results) {
  Table table = EmptyTestTable(
      "What of PhongPD helps: memory, depth or direction",
      "`followed`: Euclid's local minimum, followed along accepted iterates, "
      "its exact gradient. `mixed`: Euclid's value, Phong's direction as the "
      "derivative. `faded`: the same, its direction fading to Euclid's where "
      "less than ℓ of free way is left beyond the contact. First against "
      "second, scenes of a group together. ",
      {"first", "second", "protocol", "scenes", "runs"});
  for (const Match& match : GroupMatches(results)) {
    table.rows.push_back({match.own, match.rival, match.protocol, match.where,
                          Shown(match.duel.problems)});
    AppendTests(match.duel, &table.rows.back());
  }
  return table;
}

Table LossTable(const ConvergenceResults& results) {
  Table table{
      "Where Euclidean PD solves more, and why",
      "Where PhongPD is behind by more than 5 % of the seeds, by chance or not "
      "(the tests are above): the seeds that only Euclidean PD solved. Exactly "
      "free: PhongPD ended free all the same, but unconverged. Branch ends: of "
      "PhongPD, median; inside a solid its continuous branches end, and where "
      "a path dips into the walls on both sides of a channel again and again "
      "each end is a jump like Euclid's. Restoration: share of the iterations, "
      "PhongPD and Euclid. Objective: PhongPD's over Euclid's, median; below 1 "
      "the unconverged path goes the shorter way.",
      {"scene", "protocol", "lost", "exactly free", "branch ends",
       "restoration", "objective"},
      {}};
  for (const Match& match : SceneMatches(results)) {
    const Duel& duel = match.duel;
    if (20 * (duel.only_rival - duel.only_own) <= duel.problems) continue;
    int free = 0;
    std::vector<double> ends, ratios;
    double all[2] = {0.0, 0.0}, restoring[2] = {0.0, 0.0};
    for (const auto& [own, rival] : LostRuns(results, match)) {
      free += own->at("collision_free").get<bool>();
      ends.push_back(Number(own, "/queries/branch_ends"));
      ratios.push_back(Number(own, "/objective") / Number(rival, "/objective"));
      for (const int k : {0, 1}) {
        const Json* row = k == 0 ? own : rival;
        all[k] += Number(row, "/iterations");
        restoring[k] += Number(row, "/restoration_iterations");
      }
    }
    const auto percent = [&](int k) {
      return Rounded(100.0 * restoring[k] / std::max(1.0, all[k]), 2) + " %";
    };
    table.rows.push_back({match.where, match.protocol, Shown(duel.only_rival),
                          Shown(free), Rounded(Quantile(ends, 0.5)),
                          percent(0) + ", " + percent(1),
                          Rounded(Quantile(ratios, 0.5))});
  }
  return table;
}

namespace {

// Converged, stalled and else exactly free runs of all scenes.
std::string EndsText(const ConvergenceResults& results,
                     const std::string& protocol, const std::string& method) {
  int runs = 0, converged = 0, stalled = 0, free = 0;
  for (const ComparisonCell& c : results.cells) {
    if (c.protocol != protocol || c.method != method) continue;
    runs += c.runs;
    converged += c.solved - c.stalled;
    stalled += c.stalled;
    free += c.free_only;
  }
  return method + " " + Shown(converged) + " converged, " + Shown(stalled) +
         " stalled, " + Shown(free) + " else free of " + Shown(runs);
}

}  // namespace

std::string DuelLines(const ConvergenceResults& results) {
  std::string text;
  for (const Match& match : GroupMatches(results)) {
    if (match.where != kMany || match.own != kPreset ||
        match.rival != "euclidean") {
      continue;
    }
    const Duel& duel = match.duel;
    text += "- " + match.own + " against " + match.rival + ", " +
            match.protocol + ": solved alone " +
            Ratio(duel.only_own, duel.only_rival) + " (" +
            duel.SolvedVerdict() + "), fewer iterations " +
            Ratio(duel.fewer, duel.more) + ", median ratio " +
            duel.IterationsEffect() + " (" + duel.IterationsVerdict() +
            "). Ends: " + EndsText(results, match.protocol, match.own) + "; " +
            EndsText(results, match.protocol, match.rival) + ".\n";
  }
  // No part of the tables' family of tests.
  const std::string exact = std::string(kPreset) + "/exact";
  const std::string protocol = "straight-adaptive";
  const Duel duel =
      Arena(results.rows).Fight(protocol, exact, kRival, ScenesOf(results));
  if (duel.problems > 0) {
    text +=
        "- " + exact + " (the exact gradient, not the direction) against " +
        kRival + ", " + protocol + ", " + Shown(duel.problems) +
        " runs of each: solved alone " + Ratio(duel.only_own, duel.only_rival) +
        ", fewer iterations " + Ratio(duel.fewer, duel.more) +
        " (p = " + Rounded(duel.p_iterations, 2) +
        ", uncorrected). Ends: " + EndsText(results, protocol, exact) + ".\n";
  }
  return text;
}

}  // namespace phongpd::bench
