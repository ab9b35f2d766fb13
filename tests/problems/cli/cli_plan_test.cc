// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd plan as users run it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "planners/retraction/retraction_names.h"
#include "planners/world/planner_id.h"
#include "problems/scenes/scene_source.h"
#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

using CliPlan = CliScenes;

TEST_F(CliPlan, EveryPlannerAnswersWithTheDocumentedKeys) {
  Scene(TwoObstacles());
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  std::vector<std::string> keys;
  for (const std::string& planner : PlannerNames()) {
    const Json row =
        OneRow("plan ../scene.json --time 3 --planner " + planner, 0);
    EXPECT_EQ(row["planner"], planner);
    EXPECT_EQ(row["solved"], true) << planner;
    EXPECT_EQ(row["collision_free"], true) << planner;
    EXPECT_EQ(row["infeasible_proved"], false) << planner;
    EXPECT_GT(row["clearance"].get<double>(), 0.0) << planner;
    EXPECT_GT(row["path_length"].get<double>(), 3.0) << planner;
    ExpectFree(row, scene);
    if (keys.empty()) keys = Keys(row);
    EXPECT_EQ(Keys(row), keys) << planner;
    for (const char* key : {"scene", "metric", "seed", "retractions",
                            "branch_ends", "graph_states", "versions"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
    for (const char* key : {"contact_space", "solve"}) {
      EXPECT_TRUE(row["seconds"][key].is_number()) << key;
    }
    for (const char* key : {"collision", "segment"}) {
      EXPECT_TRUE(row["checks"][key].is_number_integer()) << key;
    }
  }
}

TEST_F(CliPlan, PresetsAreOfTheContactSurfaceAndRoutesWinOverThem) {
  const std::string plan = "plan hole:delta=0.05";
  const Json fast = OneRow(plan + " --preset fast", 0);
  EXPECT_EQ(fast["preset"], "fast");
  EXPECT_EQ(fast["routes"], 1);
  EXPECT_EQ(fast["gap_links"], 0);
  const Json more = OneRow(plan + " --preset fast --routes 4", 0);
  EXPECT_EQ(more["routes"], 4);
  EXPECT_EQ(OneRow(plan, 0)["preset"], "balanced");
  const Json sampler = OneRow(plan + " --planner retraction-forest", 0);
  EXPECT_TRUE(sampler["preset"].is_null());
  const std::string prm = plan + " --planner prm";
  ExpectRefused(prm + " --preset fast", {"--preset", "contact-surface"});
  ExpectRefused(prm + " --routes 2", {"--routes", "contact-surface"});
}

TEST_F(CliPlan, EveryRetractionSolvesAHole) {
  const phongpd::Scene scene = SceneSource("hole:delta=0.05").Load();
  for (const std::string& metric : RetractionNames()) {
    const Json row = OneRow(
        "plan hole:delta=0.05 --planner retraction-forest --time 10 --metric " +
            metric,
        0);
    EXPECT_EQ(row["metric"], metric);
    ExpectFree(row, scene);
  }
}

TEST_F(CliPlan, ContactSurfaceSolvesPassagesAndProvesTheirTwins) {
  for (const std::string family : {"gap", "hole", "tunnel", "keyhole", "comb",
                                   "snake", "bugtrap", "clutter_hole"}) {
    const std::string name = family + ":rotation_seed=3";
    const Json row = OneRow("plan " + name, 0);
    EXPECT_EQ(row["status"], "solved");
    ExpectFree(row, SceneSource(name).Load());
    const Json twin = OneRow("plan " + name + ",twin=1", 1);
    EXPECT_EQ(twin["infeasible_proved"], true) << family;
    EXPECT_EQ(twin["solved"], false);
    EXPECT_EQ(twin["collision_free"], false);
    EXPECT_TRUE(twin["path"].empty());
    EXPECT_NE(twin["reason"], "") << family;
  }
}

TEST_F(CliPlan, RetractionForestSolvesAndEndsOnTimeOnATwin) {
  const std::string forest = " --planner retraction-forest --time ";
  Json row = OneRow("plan hole:rotation_seed=3" + forest + "10", 0);
  ExpectFree(row, SceneSource("hole:rotation_seed=3").Load());
  EXPECT_GT(row["retractions"].get<int>(), 0);
  for (const std::string planner : {"retraction-forest", "prm"}) {
    row = OneRow(
        "plan hole:rotation_seed=3,twin=1 --time 0.3 --planner " + planner, 1);
    EXPECT_EQ(row["collision_free"], false);
    EXPECT_EQ(row["infeasible_proved"], false);
    EXPECT_TRUE(row["path"].empty());
    EXPECT_EQ(row["status"], "time_limit");
  }
}

TEST_F(CliPlan, RepeatsItselfToTheByteButForSeconds) {
  ExpectRepeats("plan " + Scene(TwoObstacles()) + " --planner retraction-rrt",
                "");
}

// The reason was on the terminal only; for samplers there was none.
TEST_F(CliPlan, SaysWhyAnEndIsNotFree) {
  for (const std::string planner :
       {"contact-surface", "retraction-forest", "rrt-connect", "prm"}) {
    const auto expect = [&](const char* end, const Json& place,
                            const std::string& reason) {
      Json scene = TwoObstacles();
      scene[end] = place;
      const Json row =
          OneRow("plan " + Scene(scene) + " --time 9 --planner " + planner, 1);
      EXPECT_EQ(row["reason"], reason) << planner;
      EXPECT_EQ(row["collision_free"], false) << planner;
      EXPECT_TRUE(row["path"].empty()) << planner;
      // Samplers once waited for another goal.
      EXPECT_EQ(row["checks"]["collision"], 0) << planner;
    };
    expect("start", {0.1, 0, 0}, "start (0.1,0,0) is at most 0.1 deep in wall");
    expect("goal", {0.6, 0.1, 0},
           "goal (0.6,0.1,0) is at most 0.25 deep in post");
    expect("goal", {5, 0, 0},
           "goal (5,0,0) is not strictly within the bounds: x is 3 above the "
           "maximum 2");
  }
}

// The contact space was built first, and a second one to say how deep.
TEST_F(CliPlan, BuildsNothingToSayThatAnEndIsNotFree) {
  Json scene = TwoObstacles();
  scene["goal"] = {0.1, 0, 0};
  const std::string good = "plan " + Scene(scene);
  const Json row = OneRow(good, 1);
  EXPECT_EQ(row["contact_triangles"], 0);
  EXPECT_EQ(row["seconds"]["contact_space"], 0.0);
  EXPECT_EQ(row["verified"], "confirmed");
  // A picture shows the contact space all the same.
  EXPECT_EQ(OneRow(good + " --html p.html", 1)["contact_triangles"], 0);
  EXPECT_GT(Content(Output("p.html")).size(), 1000U);
}

// D: the wall and the post with the cube around them, 2.2 high.
TEST_F(CliPlan, SeeksAClearanceInUnitsOrAsAShareOfD) {
  const double d = Eigen::Vector3d(1.05, 1.2, 2.2).norm();
  const std::string good = "plan " + Scene(TwoObstacles());
  const auto check = [&](const std::string& flag, double unit) {
    for (const std::string planner : {"contact-surface", "retraction-forest"}) {
      const Json row =
          OneRow(good + " --planner " + planner + " --clearance " + flag, 0);
      const Json& lengths = row["lengths"];
      EXPECT_NEAR(lengths["D"].get<double>(), d, 1e-12);
      EXPECT_NEAR(lengths["wanted_clearance"]["unit"].get<double>(), unit,
                  1e-12);
      EXPECT_NEAR(lengths["wanted_clearance"]["share"].get<double>(), unit / d,
                  1e-12);
      EXPECT_EQ(lengths["clearance"]["unit"], row["clearance"]);
      EXPECT_NEAR(lengths["clearance"]["share"].get<double>() * d,
                  row["clearance"].get<double>(), 1e-12);
      if (planner != "contact-surface") continue;
      // There is room: it is kept, and no more of a detour is made for it.
      EXPECT_GE(row["clearance"].get<double>(), unit) << flag;
      EXPECT_LT(row["clearance"].get<double>(), 1.1 * unit) << flag;
    }
  };
  check("0.02unit", 0.02);
  check("0.01", 0.01 * d);
  check("0.01D", 0.01 * d);
  // Told in the unit it means the same, to the byte of the path.
  const Json share = OneRow(good + " --clearance 0.125D", 0);
  const Json unit =
      OneRow(good + " --clearance " +
                 share["lengths"]["wanted_clearance"]["unit"].dump() + "unit",
             0);
  EXPECT_EQ(unit["path"], share["path"]);
  EXPECT_TRUE(
      OneRow(good + " --planner rrt-connect", 0)["lengths"]["wanted_clearance"]
          .is_null());
}

TEST_F(CliPlan, StaysWhereStartIsGoal) {
  Json scene = TwoObstacles();
  scene["goal"] = scene["start"];
  for (const std::string planner :
       {"contact-surface", "retraction-forest", "retraction-rrt"}) {
    const Json row =
        OneRow("plan " + Scene(scene) + " --planner " + planner, 0);
    EXPECT_EQ(row["collision_free"], true) << planner;
    EXPECT_EQ(row["path_length"], 0.0) << planner;
  }
}

// The box around the obstacles was taken for bounds: ends outside it were
// invalid, and there was no way around.
TEST_F(CliPlan, SamplersPlanWithoutBounds) {
  Json json = TwoObstacles();
  json.erase("bounds");
  Scene(json);
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  for (const std::string planner :
       {"contact-surface", "retraction-forest", "rrt-connect", "prm"}) {
    const Json row =
        OneRow("plan ../scene.json --time 3 --planner " + planner, 0);
    ExpectFree(row, scene);
  }
}

TEST_F(CliPlan, BoundsMayCutThePassageOrLeaveNoRoom) {
  Json row = OneRow("plan " + Scene(ShutOff()), 1);
  EXPECT_EQ(row["infeasible_proved"], true);
  // A robot that touches the wall wherever it is within the bounds; its depth
  // once was that of the bounds' shell.
  Json scene = TwoObstacles();
  scene["robot"]["shape"]["size"] = {4, 4, 4};
  scene["bounds"] = {{"min", {-1, -1, -1}}, {"max", {1, 1, 1}}};
  scene["start"] = {-0.5, 0, 0};
  scene["goal"] = {0.5, 0, 0};
  scene["obstacles"].erase(1);
  for (const std::string planner : {"contact-surface", "prm"}) {
    row =
        OneRow("plan " + Scene(scene) + " --time 0.3 --planner " + planner, 1);
    EXPECT_EQ(row["reason"], "start (-0.5,0,0) is at most 1.6 deep in wall")
        << planner;
  }
}

TEST_F(CliPlan, TakesOneObstacleOrAHundred) {
  Json json = TwoObstacles();
  json["obstacles"].erase(1);
  json["bounds"] = {{"min", {-1, -1, -1}}, {"max", {1, 1, 1}}};
  json["start"] = {-0.95, -0.95, -0.95};
  json["goal"] = {0.95, 0.95, 0.95};
  json["robot"]["shape"]["size"] = {0.1, 0.1, 0.1};
  OneRow("plan " + Scene(json), 0);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-0.8, 0.8);
  json["obstacles"].clear();
  for (int i = 0; i < 100; ++i) {
    Json& box = json["obstacles"].emplace_back(Json::object());
    box["id"] = "box" + std::to_string(i);
    box["shape"] = {{"type", "box"}, {"size", {0.15, 0.15, 0.15}}};
    for (int k = 0; k < 3; ++k) box["position"].push_back(coordinate(random));
  }
  Scene(json);
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  for (const std::string planner : {"contact-surface", "retraction-forest"}) {
    ExpectFree(OneRow("plan ../scene.json --planner " + planner, 0), scene);
  }
}

// What OMPL's statistics script looks for, and nothing of this machine.
TEST_F(CliPlan, WritesOmplsLogWithoutNamingTheMachine) {
  const Outcome outcome =
      Run("plan " + Scene(TwoObstacles()) +
          " --planner retraction-forest --time 0.5 --runs 2 --output o.jsonl "
          "--ompl-log o.log");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string log = Content(Output("o.log"));
  const std::vector<std::string> lines = Split(log, '\n');
  ASSERT_GT(lines.size(), 6U);
  EXPECT_EQ(lines[0].find("OMPL version "), 0U) << lines[0];
  EXPECT_EQ(lines[1], "Experiment two");
  EXPECT_EQ(lines[2], "0 experiment properties");
  EXPECT_EQ(lines[3], "Running on unnamed");
  EXPECT_EQ(lines[4].find("Starting at "), 0U) << lines[4];
  EXPECT_EQ(lines[5], "<<<|");
  const auto find = [&](const std::string& line) {
    return std::find(lines.begin(), lines.end(), line);
  };
  for (const std::string line :
       {"|>>>", "0.5 seconds per run", "2 runs per planner", "1 planners"}) {
    EXPECT_NE(find(line), lines.end()) << line;
  }
  // Each run is one line with a value for every property.
  const auto runs = find("2 runs");
  ASSERT_NE(runs, lines.end());
  const auto properties =
      std::find_if(lines.begin(), runs, [](const std::string& line) {
        return line.find(" properties for each run") != std::string::npos;
      });
  ASSERT_NE(properties, runs);
  EXPECT_EQ(std::stol(*properties), runs - properties - 1);
  for (int i = 1; i <= 2; ++i) {
    EXPECT_EQ(std::count((runs + i)->begin(), (runs + i)->end(), ';'),
              runs - properties - 1);
  }
  EXPECT_EQ(log.find(folder_.string()), std::string::npos);
  EXPECT_EQ(log.find(PHONGPD_PROGRAM), std::string::npos);
}

TEST_F(CliPlan, RefusesBadInputBeforeItWritesOrPrints) {
  const std::string good = "plan " + Scene(TwoObstacles());
  const std::string rest = " --output o.jsonl";
  ExpectBadRunsRefused("plan");
  ExpectRefused(good + rest + " --planner fast", {"--planner", "fast"});
  ExpectBadLengthsRefused(good + rest, "--clearance");
  ExpectRefused(good + rest + " --clearance 0", {"--clearance", "> 0"});
  ExpectRefused(good + rest + " --planner prm --clearance 0.1",
                {"--clearance", "contact-surface", "prm"});
  ExpectRefused(good + rest + " --time 0 --planner prm", {"time", "0"});
  ExpectRefused(good + rest + " --time -1 --planner prm", {"time", "-1"});
  ExpectRefused(good + rest + " --ompl-log o.log",
                {"--ompl-log", "contact-surface"});
  ExpectRefused(good + rest + " --planner prm --ompl-log o.jsonl",
                {"o.jsonl", "two outputs"});
  ExpectRefused(good + rest + " --planner prm --ompl-log nowhere/o.log",
                {"nowhere"});
  Json scene = TwoObstacles();
  scene["planning"] = {{"planner", "fast"}};
  ExpectRefused("plan " + Scene(scene) + rest, {"scene.json", "fast"});
}

}  // namespace
}  // namespace phongpd
