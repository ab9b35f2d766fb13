// SPDX-License-Identifier: GPL-3.0-or-later
// --explain tells what was taken and who chose it, and changes no answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

class CliExplain : public CliScenes {
 protected:
  // The lines on standard error, without "phongpd: "; 5 to 10 of them, each
  // once, beside what the command says without the flag.
  std::vector<std::string> Explain(const std::string& command) const {
    const Outcome plain = Run(command + " --json");
    const Outcome explained = Run(command + " --json --explain");
    EXPECT_EQ(plain.code, explained.code) << explained.err;
    EXPECT_EQ(RowOf(plain.out), RowOf(explained.out)) << command;
    std::vector<std::string> lines;
    for (const std::string& line : Split(explained.err, '\n')) {
      const bool is_new = plain.err.find(line + '\n') == std::string::npos;
      if (line.rfind("phongpd: ", 0) != 0 || !is_new) continue;
      lines.push_back(line.substr(9));
    }
    EXPECT_GE(lines.size(), 5U) << explained.err;
    EXPECT_LE(lines.size(), 10U) << explained.err;
    return lines;
  }

  static std::string RowOf(const std::string& out) {
    return WithoutSeconds(Json::parse(out)).value("path", Json()).dump();
  }

  static void ExpectLine(const std::vector<std::string>& lines,
                         const std::string& beginning) {
    EXPECT_TRUE(std::any_of(
        lines.begin(), lines.end(),
        [&](const std::string& line) { return line.rfind(beginning, 0) == 0; }))
        << "no '" << beginning << "' in\n"
        << testing::PrintToString(lines);
  }
};

TEST_F(CliExplain, BudgetsSayWhatTheyPickedAndWhatWonOverThem) {
  const std::string plan = "plan " + Scene(TwoObstacles());
  std::vector<std::string> lines = Explain(plan + " --budget 0.1");
  EXPECT_EQ(lines, Explain(plan + " --budget 100ms"));
  // Which flags: planners/solve/budget_test.cc.
  ExpectLine(lines, "budget: --");
  EXPECT_NE(testing::PrintToString(lines).find("(by --budget)"),
            std::string::npos);
  lines = Explain(plan + " --budget 0.1 --planner contact-surface");
  ExpectLine(lines, "planner: contact-surface (by --planner)");
  lines = Explain("optimize u_axis --budget 1 --preset fast");
  ExpectLine(lines, "budget: ");
  ExpectLine(lines, "preset: fast (by --preset)");
  // The metric that carries samples is not of what a budget picks.
  lines = Explain(plan + " --budget 1 --model full --planner retraction-rrt");
  ExpectLine(lines, "metric: phong (nobody asked for another)");
  const Outcome preset = Run(plan + " --budget 0.1 --preset tight");
  EXPECT_NE(preset.code, 0);
  EXPECT_NE(preset.err.find("which --budget picked; add --planner"),
            std::string::npos)
      << preset.err;
  const Outcome none = Run(plan + " --budget 0");
  EXPECT_NE(none.code, 0);
  EXPECT_NE(none.err.find("--budget"), std::string::npos) << none.err;
  const Outcome timed = Run("optimize u_axis --budget 1 --limits 1,2,10");
  EXPECT_NE(timed.err.find("--budget: expected none for a motion in time"),
            std::string::npos)
      << timed.err;
}

TEST_F(CliExplain, PlansSayWhoChosePlannerModelAndClearance) {
  const std::string plan = "plan " + Scene(TwoObstacles());
  std::vector<std::string> lines = Explain(plan);
  // By hand: the box around both obstacles grown by the robot's is 1.05 × 1.2 ×
  // 2.2 (x: -0.2 to 0.85), of diagonal 2.717.
  ExpectLine(lines, "world: D = 2.72unit, ");
  ExpectLine(lines, "preset: balanced (nobody asked for another): 3 routes");
  ExpectLine(lines, "planner: contact-surface (nobody asked for another)");
  ExpectLine(lines, "model: full, the whole contact space (auto: ");
  ExpectLine(lines, "clearance: the planner's own, 0.01 ");
  ExpectLine(lines,
             "answer: solved, free by the exact judge; on the original "
             "solids confirmed by ");
  lines = Explain(plan + " --preset tight --clearance 0.02 --model window");
  ExpectLine(lines, "preset: tight (by --preset): 8 routes");
  ExpectLine(lines,
             "clearance: 0.02 D = 0.0543unit, sought where there is "
             "room (by --clearance)");
  ExpectLine(lines, "model: window, free space alone (by --model)");
  lines = Explain(plan + " --planner rrt-connect --no-verify");
  ExpectLine(lines, "planner: rrt-connect (by --planner): samples, seed 1");
  ExpectLine(lines, "model: window, free space alone (auto: rrt-connect only");
  ExpectLine(lines, "answer: solved, free by the exact judge; not judged a");
  lines = Explain(plan + " --planner retraction-rrt --metric euclidean");
  ExpectLine(lines, "metric: euclidean (by --metric)");
}

TEST_F(CliExplain, WhatTheSceneChoosesIsTheScenes) {
  Json scene = TwoObstacles();
  scene["planning"] = {{"planner", "rrt-connect"}};
  scene["preset"] = "fast";
  scene["unit"] = "mm";
  scene["trajectory"] = {{"waypoints", 12}, {"margin", "0.02D"}};
  scene["penetration"] = {{"smoothing_length", "0.5mm"}};
  const std::string file = Scene(scene);
  ExpectLine(Explain("plan " + file), "planner: rrt-connect (by the scene)");
  const std::vector<std::string> lines = Explain("optimize " + file);
  ExpectLine(lines, "world: D = 2.72mm, ");
  ExpectLine(lines, "preset: fast (by the scene)");
  ExpectLine(lines,
             "metric: phong (nobody asked for another), smoothing "
             "length 0.184 D = 0.5mm (by the scene)");
  ExpectLine(lines,
             "margin: 0.02 D = 0.0543mm, kept where there is room (by "
             "the scene)");
}

TEST_F(CliExplain, ProofsAndEndsThatAreNotFreeAreExplainedToo) {
  ExpectLine(Explain("plan " + Scene(ShutOff())), "answer: infeasible_proved");
  Json scene = TwoObstacles();
  scene["start"] = {0.0, 0.0, 0.0};
  const std::vector<std::string> lines = Explain("plan " + Scene(scene));
  ExpectLine(lines, "model: none, nothing had to be built");
  ExpectLine(lines, "answer: start_in_collision; on the original");
}

TEST_F(CliExplain, TrajectoriesSayMetricMarginAndStages) {
  const std::string optimize = "optimize " + Scene(TwoObstacles());
  std::vector<std::string> lines = Explain(optimize);
  ExpectLine(lines, "preset: balanced (nobody asked for another): 1 route");
  ExpectLine(lines,
             "metric: phong (nobody asked for another), smoothing "
             "length 0.2 D = 0.543unit (nobody");
  ExpectLine(lines, "margin: 0.01 D = 0.0272unit");
  ExpectLine(lines, "stages: start ");
  lines = Explain(optimize + " --metric euclidean --margin 0.1unit");
  ExpectLine(lines, "metric: euclidean (by --metric)");
  ExpectLine(lines,
             "margin: 0.0368 D = 0.1unit, kept where there is room (by "
             "--margin)");
  ExpectLine(Explain(optimize + " --model window"), "metric: none, ");
}

TEST_F(CliExplain, MotionsSayWhatTheyTakeOfTheirLimits) {
  const std::vector<std::string> lines = Explain(
      "optimize " + Scene(TwoObstacles()) + " --limits 1,2,10 --time 2");
  ExpectLine(lines,
             "limits: velocity 1,1,1, acceleration 2,2,2, jerk "
             "10,10,10, of each axis (by --limits); the motion takes ");
  ExpectLine(lines, "task: 0 places on the way, as few seconds as are found");
}

}  // namespace
}  // namespace phongpd
