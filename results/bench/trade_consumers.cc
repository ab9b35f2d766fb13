// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/trade_consumers.h"

#include <map>
#include <utility>

#include "results/bench/csv_table.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

// Metrics along motions: depth against jumps.
Consumer Queries(const std::string& results) {
  const CsvTable rows = ReadCsvTable(results + "/queries/totals.csv");
  Panel panel{"", {}};
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    const double frames = rows.Number(i, "frames inside");
    panel.choices.push_back({rows.Text(i, "metric"),
                             rows.Number(i, "mean ratio"),
                             1e3 * rows.Number(i, "jumps") / frames,
                             rows.Text(i, "µs, median") + " µs"});
  }
  return {"query",
          "Query",
          "Jumps (of more than 5 % of D) against depth along motions through "
          "12 contact spaces, the hollow box apart; beside each the median "
          "time of a step. The tracker has no gradient for a solver. Rows: "
          "`results/queries/totals.csv`.",
          "mean depth / Euclidean depth",
          "jumps in 1000 frames",
          "time of a step",
          true,
          {panel}};
}

// Metrics in the optimiser: iterations against runs that are not solved.
Consumer Trajectories(const std::string& results) {
  struct Sum {
    double runs = 0.0, solved = 0.0;
    std::vector<double> iterations, seconds;
  };
  const CsvTable rows = ReadCsvTable(results + "/convergence/summary.csv");
  Consumer consumer{
      "trajectory",
      "Trajectory",
      "Ipopt from the straight, colliding line, 20 scenes of 50 seeds: runs "
      "that are not solved against the median over scenes of their median "
      "iterations; beside each the same of seconds. Where runs that are not "
      "solved "
      "differ by a point or two, that may be chance: the paired tests are in "
      "`results/convergence/verdicts.csv`. Rows: "
      "`results/convergence/summary.csv`.",
      "median iterations",
      "runs not solved, %",
      "time of a run",
      false,
      {}};
  for (const char* protocol : {"straight-adaptive", "straight-monotone"}) {
    std::map<std::string, Sum> sums;
    for (std::size_t i = 0; i < rows.rows().size(); ++i) {
      const std::string& method = rows.Text(i, "method");
      // The study's own metrics are no choice of users; where Jacobians are
      // compared there are fewer seeds.
      const bool is_choice =
          method == "euclidean" || method.compare(0, 6, "phong@") == 0;
      if (rows.Text(i, "protocol") != protocol || !is_choice ||
          method.find('/') != std::string::npos) {
        continue;
      }
      Sum& sum = sums[method];
      sum.runs += rows.Number(i, "runs");
      sum.solved += rows.Number(i, "solved");
      sum.iterations.push_back(rows.Number(i, "median_iterations"));
      sum.seconds.push_back(rows.Number(i, "median_seconds"));
    }
    Panel panel{protocol, {}};
    for (const auto& [method, sum] : sums) {
      panel.choices.push_back(
          {method, Quantile(sum.iterations, 0.5),
           100.0 * (1.0 - sum.solved / sum.runs),
           Rounded(1e3 * Quantile(sum.seconds, 0.5)) + " ms"});
    }
    consumer.panels.push_back(panel);
  }
  return consumer;
}

// Planners on narrow passages: time against runs that are not solved.
Consumer Planning(const std::string& results) {
  struct Sum {
    double runs = 0.0, solved = 0.0;
    int scenes = 0, passed = 0;  // passed: most runs have an answer
    std::vector<double> seconds;
  };
  std::map<std::string, Sum> sums;
  const CsvTable rows = ReadCsvTable(results + "/planning/samplers.csv");
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    const std::string& solved = rows.Text(i, "solved");
    const std::size_t slash = solved.find('/');
    if (slash == std::string::npos) {
      throw InputError("samplers.csv: solved: expected n/m, found '" + solved +
                       "'");
    }
    Sum& sum = sums[rows.Text(i, "planner")];
    const double answers =
        ParseDouble(solved.substr(0, slash), "samplers.csv: solved");
    const double runs =
        ParseDouble(solved.substr(slash + 1), "samplers.csv: runs");
    sum.solved += answers;
    sum.runs += runs;
    ++sum.scenes;
    sum.passed += 2.0 * answers > runs ? 1 : 0;
    sum.seconds.push_back(rows.Number(i, "median s"));
  }
  Panel panel{"", {}};
  for (const auto& [planner, sum] : sums) {
    panel.choices.push_back({planner, Quantile(sum.seconds, 0.5),
                             100.0 * (1.0 - sum.solved / sum.runs),
                             Shown(sum.passed) + "/" + Shown(sum.scenes)});
  }
  const CsvTable exact = ReadCsvTable(results + "/planning/exact.csv");
  Sum own;
  for (std::size_t i = 0; i < exact.rows().size(); ++i) {
    if (exact.Text(i, "answer") != "solved") continue;
    own.solved += exact.Text(i, "right") == "yes" ? 1.0 : 0.0;
    own.runs += 1.0;
    own.seconds.push_back(
        1e-3 * (exact.Number(i, "query ms") + exact.Number(i, "tables ms")));
  }
  panel.choices.push_back({"contact-surface", Quantile(own.seconds, 0.5),
                           100.0 * (1.0 - own.solved / own.runs),
                           Shown(static_cast<int>(own.solved)) + "/" +
                               Shown(static_cast<int>(own.runs))});
  return {"planning",
          "Planning",
          "Narrow passages with a path: runs without an answer in time against "
          "the median over scenes of their median time, that of a run "
          "without an answer being its limit; beside each on how "
          "many scenes most runs were solved. The contact space is there "
          "before either starts. `contact-surface` was run on more scenes, "
          "once each: it is deterministic. Rows: `results/planning/"
          "samplers.csv` and `exact.csv`.",
          "median seconds",
          "runs not solved, %",
          "scenes",
          true,
          {panel}};
}

// Presets and knobs that trade_benchmark measured.
Consumer Knobs(const std::string& results, const std::string& file,
               const std::string& title, const std::string& of,
               const std::vector<std::string>& consumers) {
  const CsvTable rows = ReadCsvTable(results + "/trade/knobs.csv");
  Consumer consumer{
      file,
      title,
      "Processor time over that of the default on the same instance, its "
      "median; " +
          of +
          " over the least that any choice found there, its mean, runs with an "
          "answer. Rows: `results/trade/knobs.csv`.",
      "time over that of the default",
      "excess, %",
      "answered",
      true,
      {}};
  for (const std::string& name : consumers) {
    Panel panel{consumers.size() == 1 ? "" : name, {}};
    for (std::size_t i = 0; i < rows.rows().size(); ++i) {
      if (rows.Text(i, "consumer") != name) continue;
      panel.choices.push_back(
          {rows.Text(i, "choice"), rows.Number(i, "time"),
           rows.Number(i, "mean excess, %"),
           rows.Text(i, "answered") + "/" + rows.Text(i, "instances")});
    }
    consumer.panels.push_back(panel);
  }
  return consumer;
}

// Operands simplified before the contact space is built.
Consumer Approximations(const std::string& results) {
  struct Sum {
    std::vector<double> build;
    double error = 0.0, missed = 0.0;
  };
  const CsvTable rows = ReadCsvTable(results + "/trade/approximations.csv");
  std::vector<std::pair<std::string, Sum>> sums;
  for (std::size_t i = 0; i < rows.rows().size(); ++i) {
    const std::string& choice = rows.Text(i, "choice");
    auto same = std::find_if(sums.begin(), sums.end(),
                             [&](const auto& s) { return s.first == choice; });
    if (same == sums.end()) same = sums.insert(sums.end(), {choice, {}});
    same->second.build.push_back(rows.Number(i, "time of build"));
    same->second.error += rows.Number(i, "mean error, % of D");
    same->second.missed += rows.Number(i, "missed, %");
  }
  Panel panel{"", {}};
  for (const auto& [choice, sum] : sums) {
    const auto pairs = static_cast<double>(sum.build.size());
    panel.choices.push_back({choice, Quantile(sum.build, 0.5),
                             sum.error / pairs,
                             Rounded(sum.missed / pairs) + " %"});
  }
  return {"approximation",
          "Approximated operands",
          "Processor time of a build over that of the exact one, median of "
          "six pairs, and the mean error of the Euclidean depth inside; beside "
          "each how many colliding points are told free. Rows, pair by pair "
          "and with the bound that the report proves: "
          "`results/trade/approximations.csv`.",
          "time of the build over that of the exact one",
          "mean error of depth, % of D",
          "missed",
          true,
          {panel}};
}

}  // namespace

std::vector<Consumer> ReadConsumers(const std::string& results) {
  return {Queries(results),
          Trajectories(results),
          Planning(results),
          Knobs(results, "optimize", "Presets and knobs of optimize",
                "energy of the path", {"optimize"}),
          Knobs(results, "plan", "Presets and knobs of contact-surface",
                "length of the path", {"plan"}),
          Knobs(results, "model", "Level of the model",
                "what is built included; energy or length",
                {"model: plan", "model: optimize"}),
          Approximations(results)};
}

}  // namespace phongpd::bench
