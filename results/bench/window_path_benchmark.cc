// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: what it costs to optimise a path with a metric from windows around
// it, beside the whole contact space, in one binary and one run.  Each problem
// is solved twice in either world: the second time all is modelled, so the
// difference is what modelling took, and the rest the solver.  Writes CSV into
// a directory, of which window_path_report.py makes a page.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "planners/ompl/ompl_planning.h"
#include "planners/solve/optimize.h"
#include "results/bench/free_space_measure.h"
#include "results/bench/lazy_cases.h"
#include "results/bench/program.h"
#include "results/bench/random_ends.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

struct Options {
  int problems = 1;  // of each pair
  std::uint64_t seed = 1;
  std::string pair;  // all where empty
};

struct Side {
  PathAnswer answer;
  double first = 0.0, again = 0.0;  // CPU s of the two answers
};

struct Row {
  std::string pair, start, metric;
  int problem = 0;
  double diagonal = 0.0;  // D, user's unit
  Side whole, window;
};

Side Solve(const Workspace& workspace, const OptimizeRequest& request) {
  Side side;
  const double begin = CpuSeconds();
  const World world(workspace);
  side.answer = Optimize(world, request);
  const double middle = CpuSeconds();
  Optimize(world, request);
  side.first = middle - begin;
  side.again = CpuSeconds() - middle;
  return side;
}

void Measure(const LazyCase& pair, const Options& options,
             std::vector<Row>* rows) {
  Workspace workspace;
  workspace.robot = MakeSolid(pair.robot(), "robot");
  workspace.obstacles = {MakeSolid(pair.obstacle(), "obstacle")};
  const World world(workspace);  // for the ends alone
  std::mt19937_64 random(options.seed);
  for (int problem = 0; problem < options.problems; ++problem) {
    const Ends ends = RandomEnds(world, &random);
    for (const auto& [start, metric] :
         std::vector<std::pair<TrajectoryStart, std::string>>{
             {TrajectoryStart::kStraight, "euclidean"},
             {TrajectoryStart::kStraight, "smoothed@0.02"},
             {TrajectoryStart::kStraight, "smoothed@0.2"},
             {TrajectoryStart::kRepaired, "euclidean"}}) {
      Row row;
      row.pair = pair.name;
      const bool is_straight = start == TrajectoryStart::kStraight;
      row.start = is_straight ? "straight" : "repaired";
      row.metric = metric;
      row.problem = problem;
      row.diagonal = world.diagonal();
      OptimizeRequest request;
      request.start = ends.start;
      request.goal = ends.goal;
      request.penetration = ParsePenetration(metric, "metric");
      request.options.start = start;
      request.verifies = false;
      // A solver by itself where paths are to be the same.
      if (is_straight) request.options.polish = PolishWhen::kNever;
      request.model = Model::kFull;
      row.whole = Solve(workspace, request);
      request.model = Model::kWindow;
      row.window = Solve(workspace, request);
      rows->push_back(std::move(row));
    }
  }
}

// Of two paths with as many points, the farthest apart, share of D.
double Apart(const Row& row) {
  const Path& a = row.whole.answer.path;
  const Path& b = row.window.answer.path;
  if (a.size() != b.size() || a.empty()) return 1.0;
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, (a[i] - b[i]).norm());
  }
  return most / row.diagonal;
}

NamedTable TableOf(const std::vector<Row>& rows) {
  return {
      "window_path.csv",
      MakeTable(
          {"pair", "start", "metric", "problem", "whole, CPU s",
           "whole: modelling", "windows, CPU s", "windows: modelling", "boxes",
           "faces", "penetrating queries", "whole: status", "windows: status",
           "whole: iterations", "windows: iterations", "whole: objective",
           "windows: objective", "farthest apart / D", "refusal"},
          rows, [](const Row& r, const auto& add) {
            const Side &f = r.whole, &w = r.window;
            const double build = f.first - f.again;
            const WindowUse use = w.answer.windows.value_or(WindowUse());
            add(r.pair, r.start, r.metric, r.problem, f.first, build, w.first,
                w.first - w.again, use.boxes, use.faces, use.inside,
                std::string(ToString(f.answer.status)),
                std::string(ToString(w.answer.status)),
                f.answer.pipeline->iterations, w.answer.pipeline->iterations,
                Rounded(f.answer.pipeline->objective, 6),
                Rounded(w.answer.pipeline->objective, 6), Apart(r),
                w.answer.evidence.refusal);
          })};
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->WithOutput("Paths optimised with a metric from windows: rows.");
  Options options;
  app.add_option("--problems", options.problems, "Of each pair")
      ->capture_default_str();
  app.add_option("--pair", options.pair, "Of those whose name holds this");
  app.add_option("--seed", options.seed)->capture_default_str();
  program->Parse();
  SilenceOmpl();
  std::vector<Row> rows;
  for (const LazyCase& pair : LazyCases()) {
    if (pair.name.find(options.pair) == std::string::npos) continue;
    const std::size_t before = rows.size();
    Measure(pair, options, &rows);
    const std::vector<Row> added(
        rows.begin() + static_cast<std::ptrdiff_t>(before), rows.end());
    std::cout << ToText(TableOf(added).table) << std::endl;
  }
  program->Write({TableOf(rows)});
  program->Finish(options.seed, "window_path_measured.txt");
  return 0;
}

}  // namespace phongpd::bench
