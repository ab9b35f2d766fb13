// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: how far direction and torque jump along motions that turn, and how
// long the ways out are, by Euclidean PD, PhongPD, the smoothed direction and
// the tracked wrench, on the same poses in one run.  Writes wrench.csv and
// wrench_measured.txt into a directory, of which wrench_report.py makes pages.
#include <iostream>

#include "results/bench/program.h"
#include "results/bench/wrench_measure.h"

namespace phongpd::bench {
namespace {

NamedTable RowTable(const std::vector<WrenchRow>& rows) {
  return {
      "wrench.csv",
      MakeTable({"pair", "seed", "motion", "metric", "steps", "step", "inside",
                 "direction change", "torque change", "push change", "bounded",
                 "fallbacks", "mean exit", "worst exit", "µs", "ms a space"},
                rows, [](const WrenchRow& r, const auto& add) {
                  add(r.pair, static_cast<std::size_t>(r.seed), r.motion,
                      r.metric, r.steps, r.step, r.inside, r.normal_change,
                      r.torque_change, r.push_change, r.bounded, r.fallbacks,
                      r.exit_mean, r.exit_worst, r.microseconds,
                      r.space_milliseconds);
                })};
}

}  // namespace

int Run(Program* program) {
  int steps = 32, lengths = 4;
  std::size_t pairs = 20;
  std::uint64_t seed = kWrenchSeed;
  CLI::App& app = program->WithOutput("Wrenches along motions that turn.");
  app.add_option("--pairs", pairs, "the first of them")
      ->check(CLI::Range(1, 20))
      ->capture_default_str();
  app.add_option("--seed", seed, "of the first pair; each has its own")
      ->capture_default_str();
  app.add_option("--steps", steps, "of the longest length")
      ->check(CLI::Range(2, 4096))
      ->capture_default_str();
  app.add_option("--lengths", lengths, "each half of the one before")
      ->check(CLI::Range(2, 8))
      ->capture_default_str();
  program->Parse();
  const std::vector<WrenchPair> all = WrenchPairs(seed);
  std::vector<WrenchRow> rows;
  for (std::size_t i = 0; i < pairs; ++i) {
    for (WrenchRow& row : MeasureWrenches(all[i], steps, lengths)) {
      rows.push_back(std::move(row));
    }
    std::cerr << all[i].name << '\n';
  }
  program->Write({RowTable(rows)});
  program->Finish(seed, "wrench_measured.txt");
  return 0;
}

}  // namespace phongpd::bench
