// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: planning through narrow passages. The complete planner on every
// problem, sampling planners beside each other with the same exact validator,
// many queries on one scene, and the cost of an exact motion check.  Writes
// CSV, of which planning_report.py makes the pages.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "planners/ompl/ompl_planning.h"
#include "results/bench/planning_rows.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

void Measure(const PlanningProblem& problem,
             const std::vector<std::string>& planners,
             const PlanningOptions& options, std::vector<SamplerRow>* rows) {
  std::cerr << problem.scene << '\n';
  for (SamplerRow& row : MeasureSamplers(problem, planners, options)) {
    rows->push_back(std::move(row));
  }
}

void RunSamplers(PlanningResults* results) {
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
  for (const PlanningProblem& problem : SamplerProblems()) {
    Measure(problem, planners, results->options, &results->samplers);
  }
  for (const PlanningProblem& problem : NarrowingProblems()) {
    Measure(problem, {"retraction-forest phong", "retraction-rrt phong"},
            results->options, &results->narrowing);
  }
}

int Run(int argc, char** argv) {
  CLI::App app("Planning through narrow passages: rows.");
  std::string directory;
  PlanningResults results;
  app.add_option("--output", directory, "Directory to write into")->required();
  app.add_option("--seeds", results.options.seeds)->capture_default_str();
  app.add_option("--limit", results.options.limit)->capture_default_str();
  app.add_option("--seed", results.options.seed)->capture_default_str();
  std::vector<std::string> parts = {"exact", "motions", "multi-query",
                                    "samplers"};
  app.add_option("--parts", parts, "Measure only these, for a look")
      ->check(CLI::IsMember(parts))
      ->delimiter(',');
  CLI11_PARSE(app, argc, argv);
  const auto wanted = [&parts](const std::string& part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  SilenceOmpl();

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
  if (wanted("samplers")) RunSamplers(&results);

  OutputDirectory out(directory);
  if (wanted("exact")) out.Write("exact.csv", ToCsv(ExactTable(results)));
  if (wanted("motions")) out.Write("motions.csv", ToCsv(MotionTable(results)));
  if (wanted("multi-query")) {
    out.Write("multi_query.csv", ToCsv(MultiQueryTable(results.multi_query)));
  }
  if (wanted("samplers")) out.Write("runs.csv", RunsCsv(results));
  out.Write("measured.txt",
            Circumstances(CommandLine("build/planning_benchmark", argc, argv),
                          results.options.seed) +
                "\n");
  out.Commit();
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("planning_benchmark", phongpd::bench::Run,
                                    argc, argv);
}
