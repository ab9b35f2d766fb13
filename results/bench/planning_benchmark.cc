// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: planning through narrow passages. The complete planner on every
// problem, sampling planners beside each other with the same exact validator,
// many queries on one scene, and the cost of an exact motion check.  Writes
// CSV, of which planning_report.py makes the pages.
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

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->WithOutput("Planning through narrow passages: rows.");
  PlanningResults results;
  app.add_option("--seeds", results.options.seeds)->capture_default_str();
  app.add_option("--limit", results.options.limit)->capture_default_str();
  app.add_option("--seed", results.options.seed)->capture_default_str();
  std::vector<std::string> parts = {"exact", "motions", "multi-query",
                                    "samplers"};
  app.add_option("--parts", parts, "Measure only these, for a look")
      ->check(CLI::IsMember(parts))
      ->delimiter(',');
  program->Parse();
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

  if (wanted("exact")) program->Write("exact.csv", ToCsv(ExactTable(results)));
  if (wanted("motions"))
    program->Write("motions.csv", ToCsv(MotionTable(results)));
  if (wanted("multi-query")) {
    program->Write("multi_query.csv",
                   ToCsv(MultiQueryTable(results.multi_query)));
  }
  if (wanted("samplers")) program->Write("runs.csv", RunsCsv(results));
  program->Finish(results.options.seed);
  return 0;
}

}  // namespace phongpd::bench
