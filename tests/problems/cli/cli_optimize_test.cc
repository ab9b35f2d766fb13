// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd optimize as users run it.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_io.h"
#include "problems/scenes/scene_source.h"
#include "problems/shapes/shapes.h"
#include "tests/problems/cli/cli_scenes.h"

namespace phongpd {
namespace {

using CliOptimize = CliScenes;

TEST_F(CliOptimize, WritesTheDocumentedKeys) {
  const Json row = OneRow("optimize " + Scene(TwoObstacles()), 0);
  for (const char* key : {"scene",
                          "metric",
                          "smoothing_length",
                          "jacobian",
                          "policy",
                          "seed",
                          "status",
                          "status_class",
                          "iterations",
                          "restoration_iterations",
                          "evaluations",
                          "objective",
                          "inf_pr",
                          "inf_du",
                          "collision_free",
                          "first_crossing",
                          "rounds",
                          "queries",
                          "seconds",
                          "path",
                          "versions"}) {
    EXPECT_TRUE(row.contains(key)) << key;
  }
  for (const char* key : {"cold", "warm", "branch_ends"}) {
    EXPECT_TRUE(row["queries"][key].is_number_integer()) << key;
  }
  for (const char* key : {"contact_space", "callbacks", "total"}) {
    EXPECT_TRUE(row["seconds"][key].is_number()) << key;
  }
  EXPECT_EQ(row["scene"], "two");
  EXPECT_EQ(row["metric"], "phong");
  EXPECT_EQ(row["smoothing_length"], 0.2);
  EXPECT_TRUE(row["first_crossing"].is_null());
  EXPECT_EQ(row["path"].size(), 14U);
  const Json euclidean =
      OneRow("optimize ../scene.json --metric euclidean --seed 4", 0);
  EXPECT_EQ(Keys(euclidean), Keys(row));
  EXPECT_TRUE(euclidean["smoothing_length"].is_null());
  EXPECT_EQ(euclidean["seed"], 4);
}

TEST_F(CliOptimize, ItsFreePathsAreFreeByFcl) {
  Scene(TwoObstacles());
  const phongpd::Scene scene = ReadScene(File("scene.json"));
  for (const std::string flags :
       {"", "--per-obstacle", "--start straight --metric euclidean",
        "--start straight --polish never --start-noise 0.05 --seed 3",
        "--polish always --routes 3"}) {
    const Json row = OneRow("optimize ../scene.json " + flags, 0);
    EXPECT_EQ(row["collision_free"], true) << flags;
    EXPECT_GT(row["clearance"].get<double>(), 0.0) << flags;
    ExpectFree(row, scene);
  }
  for (const std::string family : {"u_trap:triangles=80", "plate_hole"}) {
    const Json row = OneRow("optimize " + family, 0);
    EXPECT_EQ(row["collision_free"], true) << family;
    ExpectFree(row, SceneSource(family).Load());
  }
}

TEST_F(CliOptimize, PresetsAreToldAndOtherOptionsWinOverThem) {
  Json scene = TwoObstacles();
  const auto expect = [&](const std::string& flags, const char* preset,
                          int routes, bool line, const char* polish) {
    const Json row = OneRow("optimize " + Scene(scene) + flags, 0);
    EXPECT_EQ(row["preset"], preset) << flags;
    EXPECT_EQ(row["routes"], routes) << flags;
    EXPECT_EQ(row["also_line"], line) << flags;
    EXPECT_EQ(row["polish"], polish) << flags;
  };
  expect("", "balanced", 1, true, "needed");
  expect(" --preset fast", "fast", 1, false, "needed");
  expect(" --preset tight --routes 2", "tight", 2, true, "always");
  scene["preset"] = "tight";
  expect("", "tight", 3, true, "always");
  expect(" --no-line --polish never", "tight", 3, false, "never");
  expect(" --preset fast --line", "fast", 1, true, "needed");
  scene["preset"] = "slow";
  ExpectRefused("optimize " + Scene(scene), {"/preset", "slow"});
  ExpectRefused("optimize u_axis --preset slow", {"--preset", "slow"});
}

TEST_F(CliOptimize, RepeatsItselfToTheByteButForSeconds) {
  ExpectRepeats("optimize " + Scene(TwoObstacles()) +
                    " --start straight --start-noise 0.1",
                " --no-cache");
}

TEST_F(CliOptimize, TellsWhichEndIsHowDeepInWhat) {
  const auto expect = [&](const char* end, const Json& place,
                          const std::string& status,
                          const std::vector<std::string>& words) {
    Json scene = TwoObstacles();
    scene[end] = place;
    for (const std::string flags :
         {"", " --start straight", " --per-obstacle"}) {
      const Json row = OneRow("optimize " + Scene(scene) + flags, 1);
      EXPECT_EQ(row["status_class"], status);
      EXPECT_EQ(row["collision_free"], false);
      EXPECT_EQ(row["solved"], false);
      EXPECT_TRUE(row["path"].empty());
      // It is said before anything is built.
      EXPECT_EQ(row["contact_triangles"], 0);
      EXPECT_EQ(row["seconds"]["contact_space"], 0.0);
      for (const std::string& word : words) {
        EXPECT_NE(row["reason"].get<std::string>().find(word),
                  std::string::npos)
            << word << " in " << row["reason"];
      }
    }
  };
  expect("start", {0.1, 0, 0}, "start_in_collision",
         {"start (0.1,0,0)", "at most 0.1 deep in wall"});
  expect("goal", {0.6, 0.1, 0}, "goal_in_collision",
         {"at most 0.25 deep in post"});
  expect("goal", {5, 0, 0}, "goal_out_of_bounds",
         {"goal (5,0,0)",
          "not strictly within the bounds: x is 3 above the maximum 2"});
  expect("goal", {2, 0, 0}, "goal_out_of_bounds",
         {"not strictly within the bounds: x is on the maximum 2"});
}

TEST_F(CliOptimize, AnswersWhereStartIsGoal) {
  Json scene = TwoObstacles();
  scene["goal"] = scene["start"];
  for (const std::string flags : {"", " --start straight", " --routes 2"}) {
    const Json row = OneRow("optimize " + Scene(scene) + flags, 0);
    EXPECT_EQ(row["collision_free"], true);
    EXPECT_EQ(row["objective"], 0.0);
    for (const Json& p : row["path"]) EXPECT_EQ(p, scene["start"]);
  }
}

TEST_F(CliOptimize, ProvesThatThereIsNoPath) {
  Json row = OneRow("optimize " + Scene(ShutOff()), 1);
  EXPECT_EQ(row["status_class"], "infeasible_proved");
  EXPECT_EQ(row["collision_free"], false);
  row = OneRow("optimize ../scene.json --start straight --time 2", 1);
  EXPECT_EQ(row["status_class"], "failed");
  EXPECT_EQ(row["collision_free"], false);
  EXPECT_TRUE(row["first_crossing"].is_object());
  row = OneRow("optimize hole:twin=1,rotation_seed=2", 1);
  EXPECT_EQ(row["status_class"], "infeasible_proved");
}

TEST_F(CliOptimize, KeepsWhatClearanceThereIsBelowTheMargin) {
  Json scene = TwoObstacles();
  scene["trajectory"]["margin"] = "0.4D";  // of the diagonal; the room is less
  const Json row = OneRow("optimize " + Scene(scene), 0);
  EXPECT_EQ(row["collision_free"], true);
  EXPECT_LT(row["lengths"]["clearance"]["share"].get<double>(), 0.4);
  ExpectFree(row, ReadScene(File("scene.json")));
}

// D: the wall and the post with the cube around them, 2.2 high.
TEST_F(CliOptimize, TakesLengthsInUnitsOrAsSharesOfD) {
  const double d = Eigen::Vector3d(1.05, 1.2, 2.2).norm();
  const std::string good = "optimize " + Scene(TwoObstacles());
  const Json plain = OneRow(good, 0);
  EXPECT_NEAR(plain["lengths"]["D"].get<double>(), d, 1e-12);
  EXPECT_EQ(plain["lengths"]["margin"]["share"], 0.01);
  EXPECT_EQ(plain["lengths"]["smoothing_length"]["share"], 0.2);
  EXPECT_NEAR(plain["lengths"]["smoothing_length"]["unit"].get<double>(),
              0.2 * d, 1e-12);
  EXPECT_EQ(plain["lengths"]["clearance"]["unit"], plain["clearance"]);
  // Powers of two lose nothing on the way: the same bytes.
  const Json share =
      OneRow(good + " --margin 0.0625 --smoothing-length 0.125D", 0);
  const auto in_unit = [&](const char* key) {
    return share["lengths"][key]["unit"].dump() + "unit";
  };
  Json unit = OneRow(good + " --margin " + in_unit("margin") +
                         " --smoothing-length " + in_unit("smoothing_length"),
                     0);
  EXPECT_EQ(unit["path"], share["path"]);
  EXPECT_EQ(unit["lengths"], share["lengths"]);
  EXPECT_EQ(unit["method"], "phong@" + in_unit("smoothing_length"));
  EXPECT_GE(share["clearance"].get<double>(), 0.9 * 0.0625 * d);
  // The same, asked for by the scene.
  Json scene = TwoObstacles();
  scene["trajectory"]["margin"] = in_unit("margin");
  scene["penetration"]["smoothing_length"] = in_unit("smoothing_length");
  EXPECT_EQ(OneRow("optimize " + Scene(scene, "unit.json"), 0)["path"],
            share["path"]);
}

// One obstacle's contact space is smaller than the world; a field takes no
// more than its diagonal, and the row says so.
// D is the world's, also where obstacles that are smaller have a space each.
TEST_F(CliOptimize, AShareOfDIsOneLengthWhateverSpacesAreBuilt) {
  const std::string good =
      "optimize " + Scene(TwoObstacles()) + " --smoothing-length 1";
  const Json merged = OneRow(good, 0)["lengths"];
  const Json each = OneRow(good + " --per-obstacle", 0)["lengths"];
  EXPECT_EQ(merged["D"], each["D"]);
  EXPECT_EQ(merged["smoothing_length"], each["smoothing_length"]);
  EXPECT_EQ(merged["smoothing_length"]["unit"], merged["D"]);
}

TEST_F(CliOptimize, ReadsMeshesBesideTheScene) {
  WriteMesh(MakeBox({-0.1, -0.5, -0.5}, {0.1, 0.5, 0.5}), File("wall.obj"));
  Json scene = TwoObstacles();
  scene["obstacles"][0] = {{"id", "wall"}, {"mesh", "wall.obj"}};
  const Json row = OneRow("optimize " + Scene(scene), 0);
  EXPECT_EQ(row["collision_free"], true);
  ExpectFree(row, ReadScene(File("scene.json")));
}

TEST_F(CliOptimize, RefusesBadInputBeforeItWritesOrPrints) {
  ExpectBadRunsRefused("optimize");
  const std::string rest = " --output o.jsonl";
  const auto with = [&](const char* pointer, const Json& value) {
    Json scene = TwoObstacles();
    scene[Json::json_pointer(pointer)] = value;
    return "optimize " + Scene(scene) + rest;
  };
  ExpectRefused(with("/trajectory/waypoint", 3), {"scene.json", "waypoint"});
  ExpectRefused(with("/trajectory/margin", "1 km"), {"scene.json", "margin"});
  ExpectRefused(with("/roboter", 3), {"scene.json", "roboter"});
  ExpectRefused(with("/trajectory/ipopt", {{"tool", 1e-6}}), {"tool"});
  ExpectRefused(with("/trajectory/ipopt", {{"tol", "abc"}}), {"tol", "abc"});
  ExpectRefused(with("/trajectory/ipopt", {{"max_iter", 2.5}}),
                {"max_iter", "2.5"});
  const std::string good = "optimize " + Scene(TwoObstacles());
  ExpectRefused(good + " --output ../scene.json/o.jsonl", {"scene.json"});
  ExpectRefused("optimize no_such_family" + rest, {"no_such_family"});
  ExpectRefused("optimize u_trap:bar=1" + rest, {"bar"});
  ExpectRefused("optimize u_trap:wall" + rest, {"wall"});
  ExpectRefused("optimize u_trap:wall=thick" + rest, {"wall", "thick"});
  ExpectRefused("optimize u_trap:wall=9" + rest, {"wall"});
  ExpectRefused(good + rest + " --smoothing-length 2", {"smoothing", "2"});
  ExpectBadLengthsRefused(good + rest, "--margin");
  ExpectBadLengthsRefused(good + rest, "--smoothing-length");
  ExpectRefused(good + rest + " --margin 0unit", {"--margin", "> 0"});
  ExpectRefused(good + rest + " --routes 9", {"routes", "9"});
  ExpectRefused(good + rest + " --rows -1", {"rows", "-1"});
  ExpectRefused(good + rest + " --time 0", {"time", "0"});
  ExpectRefused(good + rest + " --start-noise 0.1", {"--start-noise"});
  ExpectRefused(good + rest + " --start straight --start-noise nan",
                {"--start-noise", "nan"});
}

}  // namespace
}  // namespace phongpd
