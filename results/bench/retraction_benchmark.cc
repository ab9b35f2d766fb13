// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: retraction along all Phong branches against baselines of equal
// strength: all local Euclidean projections, and as many random contact points
// as there are branches.  The same planner, seeds and exact motion checks;
// samples until it is solved, which no clock is in but that of the limit.
// Writes baselines.csv, of which passages_report.py makes tests and
// baselines.md.
#include <cmath>
#include <iostream>
#include <limits>

#include "planners/ompl/ompl_planning.h"
#include "problems/output/text.h"
#include "results/bench/planning_measure.h"
#include "results/bench/program.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

// All Phong branches against one baseline on one scene, seed by seed.
struct Duel {
  std::string scene, baseline;
  int runs = 0, solved = 0, phong_solved = 0;
  int wins = 0, losses = 0;                 // fewer samples, of Phong
  double median = 0.0, phong_median = 0.0;  // samples
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
  return Quantile(samples, 0.5);
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
  return duel;
}

std::string OrMore(double samples) {
  return std::isfinite(samples) ? Rounded(samples, 4) : "not solved";
}

Table DuelTable(const std::vector<Duel>& duels) {
  return MakeTable(
      {"scene", "baseline", "Phong solved", "solved", "Phong samples",
       "samples", "fewer : more"},
      duels, [](const Duel& d, const auto& add) {
        const std::string of = "/" + std::to_string(d.runs);
        add(d.scene, d.baseline, std::to_string(d.phong_solved) + of,
            std::to_string(d.solved) + of, OrMore(d.phong_median),
            OrMore(d.median),
            std::to_string(d.wins) + " : " + std::to_string(d.losses));
      });
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->WithOutput("Retraction against baselines of equal strength.");
  PlanningOptions options;
  options.seeds = 30;
  options.limit = 2.0;
  app.add_option("--seeds", options.seeds)->capture_default_str();
  app.add_option("--limit", options.limit)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  program->Parse();
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
  program->Write("baselines.csv", ToCsv(DuelTable(duels)));
  program->Finish(options.seed, "baselines_measured.txt");
  return 0;
}

}  // namespace phongpd::bench
