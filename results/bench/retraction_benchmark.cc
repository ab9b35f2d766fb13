// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: retraction along all Phong branches against baselines of equal
// strength: all local Euclidean projections, and as many random contact points
// as there are branches.  The same planner, seeds and exact motion checks;
// samples until it is solved, which no clock is in.  Writes baselines.csv and
// baselines.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "planners/ompl/ompl_planning.h"
#include "problems/output/text.h"
#include "results/bench/paired_test.h"
#include "results/bench/planning_measure.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

constexpr double kLevel = 0.05;

// All Phong branches against one baseline on one scene, seed by seed.
struct Duel {
  std::string scene, baseline;
  int runs = 0, solved = 0, phong_solved = 0;
  int wins = 0, losses = 0;                 // fewer samples, of Phong
  double median = 0.0, phong_median = 0.0;  // samples
  double p = 1.0;                           // after Holm's correction

  std::string Verdict() const {
    if (p >= kLevel) return "tie";
    return wins > losses ? "win" : "loss";
  }
};

// Runs without an answer took more samples than any other.
double Samples(const SamplerRow& row, std::size_t run) {
  if (run >= row.runs.size() || !row.runs[run].is_solved) {
    return std::numeric_limits<double>::infinity();
  }
  return row.runs[run].samples;
}

double MedianSamples(const SamplerRow& row, std::size_t runs) {
  std::vector<double> samples;
  for (std::size_t i = 0; i < runs; ++i) samples.push_back(Samples(row, i));
  std::sort(samples.begin(), samples.end());
  return samples[runs / 2];
}

Duel Compare(const SamplerRow& phong, const SamplerRow& other,
             const PlanningOptions& options) {
  Duel duel;
  duel.scene = other.problem.scene;
  duel.baseline = other.planner.substr(other.planner.find(' ') + 1);
  duel.runs = options.seeds;
  const auto runs = static_cast<std::size_t>(options.seeds);
  for (std::size_t i = 0; i < runs; ++i) {
    const double a = Samples(phong, i), b = Samples(other, i);
    duel.phong_solved += std::isfinite(a) ? 1 : 0;
    duel.solved += std::isfinite(b) ? 1 : 0;
    duel.wins += a < b ? 1 : 0;
    duel.losses += b < a ? 1 : 0;
  }
  duel.median = MedianSamples(other, runs);
  duel.phong_median = MedianSamples(phong, runs);
  duel.p = SignTest(duel.wins, duel.losses);
  return duel;
}

std::string OrMore(double samples) {
  return std::isfinite(samples) ? Rounded(samples, 4) : "not solved";
}

Table DuelTable(const std::vector<Duel>& duels) {
  return MakeTable(
      "All Phong branches against each baseline",
      "Median samples until solved. Fewer: seeds on which Phong took fewer "
      "samples, and on which it took more. p: exact sign test over the seeds, "
      "Holm's correction over all rows; win or loss below 0.05, else tie.",
      {"scene", "baseline", "Phong solved", "solved", "Phong samples",
       "samples", "fewer : more", "p", "Phong"},
      duels, [](const Duel& d, const auto& add) {
        const std::string of = "/" + std::to_string(d.runs);
        add(d.scene, d.baseline, std::to_string(d.phong_solved) + of,
            std::to_string(d.solved) + of, OrMore(d.phong_median),
            OrMore(d.median),
            std::to_string(d.wins) + " : " + std::to_string(d.losses), d.p,
            d.Verdict());
      });
}

std::string Findings(const std::vector<Duel>& duels,
                     const std::vector<std::string>& baselines) {
  std::string text;
  for (const std::string& baseline : baselines) {
    int wins = 0, ties = 0, losses = 0;
    for (const Duel& d : duels) {
      if (d.baseline != baseline) continue;
      const std::string verdict = d.Verdict();
      wins += verdict == "win" ? 1 : 0;
      ties += verdict == "tie" ? 1 : 0;
      losses += verdict == "loss" ? 1 : 0;
    }
    text += "- Against `" + baseline + "`: " + std::to_string(wins) +
            " wins, " + std::to_string(ties) + " ties, " +
            std::to_string(losses) + " losses.\n";
  }
  return text;
}

constexpr char kIntroduction[] =
    R"(# Retraction against baselines of equal strength

A colliding sample has many projections along Phong directions, and one nearest
point: a comparison of those two is one of many candidates with one. Here the
baselines are as strong: `euclidean-all` takes every point that is the nearest
one around it, `contact-points` as many random points of the contact space as
there are Phong branches, `contact-point` one of them. `retraction-forest`, the
same seeds and exact motion checks for all.

)";

int Run(int argc, char** argv) {
  CLI::App app("Retraction against baselines of equal strength.");
  std::string directory;
  PlanningOptions options;
  options.seeds = 30;
  options.limit = 2.0;
  app.add_option("--output", directory, "Directory to write into")->required();
  app.add_option("--seeds", options.seeds)->capture_default_str();
  app.add_option("--limit", options.limit)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  SilenceOmpl();
  const std::vector<std::string> baselines = {
      "euclidean", "euclidean-all", "contact-point", "contact-points"};
  std::vector<std::string> planners = {"retraction-forest phong"};
  for (const std::string& name : baselines) {
    planners.push_back("retraction-forest " + name);
  }
  std::vector<Duel> duels;
  for (const PlanningProblem& problem : SamplerProblems()) {
    std::cerr << problem.scene << std::endl;
    const std::vector<SamplerRow> rows =
        MeasureSamplers(problem, planners, options);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      duels.push_back(Compare(rows[0], rows[i], options));
    }
  }
  std::vector<double> p;
  for (const Duel& duel : duels) p.push_back(duel.p);
  p = Holm(p);
  for (std::size_t i = 0; i < duels.size(); ++i) duels[i].p = p[i];
  const Table table = DuelTable(duels);
  const std::string findings = Findings(duels, baselines);
  OutputDirectory out(directory);
  out.Write("baselines.csv", ToCsv(table));
  out.Write(
      "baselines.md",
      kIntroduction + findings + "\n" + ToMarkdown(table) +
          "\nRows: [baselines.csv](baselines.csv)\n\n" +
          Circumstances(CommandLine("build/retraction_benchmark", argc, argv),
                        options.seed) +
          "\n");
  out.Commit();
  std::cout << findings;
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("retraction_benchmark", phongpd::bench::Run,
                                    argc, argv);
}
