// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: planning through narrow passages. The complete planner on every
// problem, sampling planners beside each other with the same exact validator,
// many queries on one scene, and the cost of an exact motion check.  Writes
// CSV, SVG and README.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "planners/ompl/ompl_planning.h"
#include "problems/output/gnuplot.h"
#include "results/bench/planning_report.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

constexpr char kIntroduction[] =
    R"(# Planning through narrow passages

A cube, a peg or a hook translates; δ is the side of the free channel in a world
of size 2. Twins are the same scenes with the channel closed by 1e-4. "Turned"
scenes (`rotation_seed=1`) lose every alignment with the axes. Every path is
judged by exact segment tests, whatever a planner claims.

)";

int Run(int argc, char** argv) {
  CLI::App app("Planning through narrow passages: tables and figures.");
  std::string directory, worlds;
  PlanningResults results;
  app.add_option("--output", directory, "Directory to write into")->required();
  app.add_option("--seeds", results.options.seeds)->capture_default_str();
  app.add_option("--limit", results.options.limit)->capture_default_str();
  app.add_option("--seed", results.options.seed)->capture_default_str();
  app.add_option("--voxel-worlds", worlds,
                 "What the voxel-world test printed, quoted in the README");
  std::vector<std::string> parts = {"exact", "motions", "multi-query",
                                    "samplers"};
  app.add_option("--parts", parts, "Measure only these, for a look")
      ->check(CLI::IsMember(parts))
      ->delimiter(',');
  CLI11_PARSE(app, argc, argv);
  const auto wanted = [&parts](const std::string& part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  RequireGnuplot();
  SilenceOmpl();
  const std::string command =
      CommandLine("build/planning_benchmark", argc, argv);

  if (wanted("exact")) {
    for (const PlanningProblem& problem : ExactProblems()) {
      results.exact.push_back(MeasureExact(problem));
    }
  }
  if (wanted("motions")) {
    for (const char* scene : {"ball_wrench", "clutter", "knot"}) {
      results.motions.push_back(MeasureMotions(scene, results.options.seed));
    }
  }
  if (wanted("multi-query")) {
    constexpr int kQueries = 100;
    for (const std::string& scene : MultiQueryScenes()) {
      for (MultiQueryRow& row :
           MeasureMultiQuery(scene, kQueries, results.options.seed)) {
        results.multi_query.push_back(std::move(row));
      }
    }
  }
  const std::vector<std::string> planners = {"retraction-forest phong",
                                             "retraction-forest phong-random",
                                             "retraction-forest phong-novelty",
                                             "retraction-forest phong-nearest",
                                             "retraction-forest euclidean",
                                             "retraction-forest contact-point",
                                             "retraction-rrt phong",
                                             "retraction-rrt euclidean",
                                             "rrt-connect",
                                             "prm",
                                             "prm-obstacle-based",
                                             "prm-gaussian",
                                             "prm-bridge"};
  const auto measure = [&](const PlanningProblem& problem,
                           const std::vector<std::string>& names,
                           std::vector<SamplerRow>* rows) {
    std::cerr << problem.scene << '\n';
    for (SamplerRow& row : MeasureSamplers(problem, names, results.options)) {
      rows->push_back(std::move(row));
    }
  };
  if (wanted("samplers")) {
    for (const PlanningProblem& problem : SamplerProblems()) {
      measure(problem, planners, &results.samplers);
    }
    for (const PlanningProblem& problem : NarrowingProblems()) {
      measure(problem, {"retraction-forest phong", "retraction-rrt phong"},
              &results.narrowing);
    }
  }

  OutputDirectory out(directory);
  out.Write("runs.csv", RunsCsv(results));
  const std::vector<NamedTable> tables = Tables(results);
  const std::vector<Figure> figures = Figures(results);
  std::string text = kIntroduction + Findings(results) + '\n';
  if (!worlds.empty()) {
    text += "Random voxel worlds against flood fill: " + worlds + ".\n\n";
  }
  text +=
      "Every run of the samplers: [runs.csv](runs.csv). Retraction against "
      "baselines of equal strength: [baselines.md](baselines.md). How narrow a "
      "passage each planner takes in 1, 10 and 60 s: "
      "[widths.md](widths.md).\n\n" +
      ToMarkdown(tables, figures) + '\n' +
      Circumstances(command, results.options.seed);
  WriteReport(tables, figures, text, &out);
  out.Commit();
  std::cout << Findings(results);
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("planning_benchmark", phongpd::bench::Run,
                                    argc, argv);
}
