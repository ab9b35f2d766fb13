// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: how wide a passage has to be for OMPL's samplers, given 1, 10 and 60
// seconds, beside the retraction planners and the complete one, with the same
// exact motion checks.  Writes widths.csv and widths.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>

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
      "Passages from wide to narrow",
      "Solved within 1, 10 and 60 s, of the runs, and the median time of those "
      "solved. –: not asked, as no run solved the next wider passage in 60 s.",
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

// The narrowest passage that each planner went through in every run.
std::string Findings(const std::vector<Passage>& passages) {
  std::string text;
  int wrong = 0;
  double slowest = 0.0;
  std::map<std::string, std::map<std::string, double>> sure;  // by planner
  for (const Passage& passage : passages) {
    wrong += passage.exact_is_right ? 0 : 1;
    slowest = std::max(slowest, passage.exact_milliseconds);
    for (std::size_t i = 0; i < kPlanners.size(); ++i) {
      if (!passage.cells[i].IsSure()) continue;
      double& least = sure[kPlanners[i]]
                          .emplace(passage.problem.family, 1e300)
                          .first->second;
      least = std::min(least, passage.problem.delta);
    }
  }
  for (const std::string& planner : kPlanners) {
    std::vector<std::string> widths;
    for (const auto& [scene, width] : sure[planner]) {
      widths.push_back(scene + " " + FormatDouble(width));
    }
    text += "- `" + planner + "`: ";
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text += (i == 0 ? "" : ", ") + widths[i];
    }
    text += widths.empty() ? "none of these passages.\n" : ".\n";
  }
  text += "- `contact-surface`: all " + std::to_string(passages.size()) +
          (wrong == 0 ? "" : " but " + std::to_string(wrong)) + ", at most " +
          Rounded(slowest) + " ms once its tables are there.\n";
  return text;
}

constexpr char kIntroduction[] =
    R"(# How narrow a passage may be

δ is the side of the free channel in a world of size 2. OMPL's samplers with
OMPL's own settings (`rrt-connect`: the range that its setup takes from the
space's extent; `prm`: its connection strategy; the others: `prm` with its
obstacle-based, Gaussian and bridge-test samplers), 60 s a run, and how many runs
were solved after 1, 10 and 60 s. A planner whose first run fails in one passage
has no further ones there, nor in narrower ones. All planners have the same exact
motion checks. Narrowest δ of which every run was solved:

)";

int Run(int argc, char** argv) {
  CLI::App app("How narrow a passage may be, for each planner.");
  std::string directory;
  std::vector<std::string> scenes = kScenes;
  PlanningOptions options;
  options.seeds = 3;
  options.hopeless = 1;
  options.limit = kLimits[2];
  app.add_option("--output", directory, "Directory to write into")->required();
  app.add_option("--seeds", options.seeds)->capture_default_str();
  app.add_option("--seed", options.seed)->capture_default_str();
  app.add_option("--scenes", scenes)->check(CLI::IsMember(kScenes));
  CLI11_PARSE(app, argc, argv);
  SilenceOmpl();
  const std::string command = CommandLine("build/width_benchmark", argc, argv);
  std::vector<Passage> passages;
  for (const std::string& scene : scenes) {
    for (Passage& passage : Measure(scene, options)) {
      passages.push_back(std::move(passage));
    }
    // What is there stays if the rest is interrupted.
    const Table table = WidthTable(passages);
    OutputDirectory out(directory);
    out.Write("widths.csv", ToCsv(table));
    out.Write("widths.md", kIntroduction + Findings(passages) + "\n" +
                               ToMarkdown(table) +
                               "\nRows: [widths.csv](widths.csv)\n\n" +
                               Circumstances(command, options.seed) + "\n");
    out.Commit();
  }
  std::cout << Findings(passages);
  return 0;
}

}  // namespace
}  // namespace phongpd::bench

int main(int argc, char** argv) {
  return phongpd::bench::RunProgram("width_benchmark", phongpd::bench::Run,
                                    argc, argv);
}
