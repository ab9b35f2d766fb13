// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: how wide a passage has to be for OMPL's samplers, given 1, 10 and 60
// seconds, beside the retraction planners and the complete one, with the same
// exact motion checks.  Writes widths.csv, of
// which passages_report.py makes widths.md.
#include <algorithm>
#include <iostream>

#include "planners/ompl/ompl_planning.h"
#include "problems/output/text.h"
#include "results/bench/planning_measure.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

constexpr double kLimits[] = {1.0, 10.0, 60.0};  // seconds
constexpr double kWidths[] = {0.1, 0.02, 0.005, 0.001, 2e-4, 2e-5};
const std::vector<std::string> kScenes = {"hole", "snake", "bugtrap"};
const std::vector<std::string> kPlanners = {"rrt-connect",
                                            "prm",
                                            "prm-obstacle-based",
                                            "prm-gaussian",
                                            "prm-bridge",
                                            "retraction-rrt phong",
                                            "retraction-forest phong"};

// One planner in one passage.
struct Cell {
  int runs = 0;
  int solved[3] = {0, 0, 0};  // within each limit
  double seconds = 0.0;       // median of the solved ones
  bool is_asked = true;       // not where a wider passage was hopeless
  bool is_false = false;      // a path claimed that is not free

  bool IsHopeless() const { return !is_asked || solved[2] == 0; }
  bool IsSure() const { return is_asked && solved[2] == runs; }
};

struct Passage {
  PlanningProblem problem;
  double exact_milliseconds = 0.0;  // of the complete planner
  bool exact_is_right = false;
  std::vector<Cell> cells;  // as kPlanners
};

PlanningProblem ProblemOf(const std::string& family, double width) {
  PlanningProblem problem;
  problem.family = family;
  problem.delta = width;
  problem.scene = family + ":delta=" + FormatDouble(width);
  return problem;
}

Cell CellOf(const SamplerRow& row) {
  Cell cell;
  cell.runs = static_cast<int>(row.runs.size());
  std::vector<double> seconds;
  for (const SamplerRun& run : row.runs) {
    cell.is_false |= run.is_false;
    if (!run.is_solved) continue;
    seconds.push_back(run.seconds);
    for (int k = 0; k < 3; ++k) cell.solved[k] += run.seconds <= kLimits[k];
  }
  // The limit is looked at between steps: what ends just after it counts.
  cell.solved[2] = static_cast<int>(seconds.size());
  cell.seconds = Quantile(seconds, 0.5);
  return cell;
}

std::vector<Passage> Measure(const std::string& scene,
                             const PlanningOptions& options) {
  std::vector<Passage> passages;
  std::vector<char> is_hopeless(kPlanners.size(), 0);
  for (const double width : kWidths) {
    Passage passage;
    passage.problem = ProblemOf(scene, width);
    const ExactRow exact = MeasureExact(passage.problem);
    passage.exact_milliseconds = exact.milliseconds;
    passage.exact_is_right = exact.is_right;
    for (std::size_t i = 0; i < kPlanners.size(); ++i) {
      Cell cell;
      cell.is_asked = !is_hopeless[i];
      if (cell.is_asked) {
        cell = CellOf(
            MeasureSamplers(passage.problem, {kPlanners[i]}, options)[0]);
        std::cerr << passage.problem.scene << ", " << kPlanners[i] << ": "
                  << cell.solved[2] << " of " << cell.runs << std::endl;
      }
      is_hopeless[i] = cell.IsHopeless();
      passage.cells.push_back(cell);
    }
    passages.push_back(std::move(passage));
  }
  return passages;
}

Table WidthTable(const std::vector<Passage>& passages) {
  return MakeTable(
      {"scene", "δ", "planner", "1 s", "10 s", "60 s", "runs", "median s"},
      passages, [](const Passage& passage, const auto& add) {
        const std::string& scene = passage.problem.family;
        const std::string width = FormatDouble(passage.problem.delta);
        const char* right = passage.exact_is_right ? "1" : "0";
        add(scene, width, "contact-surface", right, right, right, 1,
            1e-3 * passage.exact_milliseconds);
        for (std::size_t i = 0; i < kPlanners.size(); ++i) {
          const Cell& cell = passage.cells[i];
          if (!cell.is_asked) {
            add(scene, width, kPlanners[i], "–", "–", "–", 0, "–");
            continue;
          }
          add(scene, width, kPlanners[i], cell.solved[0], cell.solved[1],
              cell.solved[2], cell.runs,
              cell.solved[2] > 0 ? Rounded(cell.seconds) : "–");
        }
      });
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->WithOutput("How narrow a passage may be, for each planner.");
  std::vector<std::string> scenes = kScenes;
  PlanningOptions options;
  options.seeds = 3;
  options.hopeless = 1;
  options.limit = kLimits[2];
  app.add_option("--seeds", options.seeds)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  app.add_option("--scenes", scenes)->check(CLI::IsMember(kScenes));
  program->Parse();
  SilenceOmpl();
  std::vector<Passage> passages;
  for (const std::string& scene : scenes) {
    for (Passage& passage : Measure(scene, options)) {
      passages.push_back(std::move(passage));
    }
    // What is there stays if the rest is interrupted.
    program->Write("widths.csv", ToCsv(WidthTable(passages)));
    program->Finish(options.seed, "widths_measured.txt");
  }
  return 0;
}

}  // namespace phongpd::bench
