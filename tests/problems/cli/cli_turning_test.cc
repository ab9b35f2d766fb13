// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd plan of a robot that turns: a plank that lies across the slit it has
// to pass.  Truth: FCL at many poses of the path that was written.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "constraints/rigid/rigid_judge.h"
#include "constraints/rigid/rigid_motion.h"
#include "problems/scenes/turning_scene.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using Eigen::Vector3d;

class CliTurning : public Cli {
 protected:
  // The plank is 1.6 wide; the slit between two walls 0.5, and as high as they.
  static Json Slit() {
    return Json::parse(R"({"name": "slit", "unit": "m",
      "robot": {"turns": true, "shape": {"type": "box", "size": [0.2, 1.6, 0.2]}},
      "obstacles": [
        {"id": "left", "shape": {"type": "box", "size": [0.4, 3, 3]},
         "position": [0, -1.75, 0]},
        {"id": "right", "shape": {"type": "box", "size": [0.4, 3, 3]},
         "position": [0, 1.75, 0]}],
      "start": [-2, 0, 0], "goal": [2, 0, 0],
      "goal_rotation": {"axis": [0, 0, 1], "degrees": 180},
      "bounds": {"min": [-4, -3, -1.2], "max": [4, 3, 1.2]},
      "planning": {"time_limit": 60}})");
  }

  std::string Write(const Json& scene) const {
    WriteText("scene.json", scene.dump());
    return "../scene.json";
  }

  static RobotPose PoseOf(const Json& x) {
    RobotPose pose;
    pose.position = Vector3d(x[0], x[1], x[2]);
    pose.orientation = Eigen::Quaterniond(x[3], x[4], x[5], x[6]);
    return pose;
  }
};

TEST_F(CliTurning, TurnsAPlankThroughASlit) {
  const Outcome outcome = Run("plan " + Write(Slit()) +
                              " --seed 3 --output rows.jsonl --html p.html");
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  const Json row = Json::parse(Content(Output("rows.jsonl")));
  EXPECT_EQ(row["status"], "solved");
  EXPECT_EQ(row["collision_free"], true);
  const Json& path = row["path"];
  ASSERT_GE(path.size(), 3U);
  EXPECT_EQ(path.front(), row["start"]);
  EXPECT_EQ(path.back(), row["goal"]);
  EXPECT_EQ(PoseOf(path.front()).position, Vector3d(-2, 0, 0));
  EXPECT_NEAR(std::abs(PoseOf(path.back()).orientation.z()), 1.0, 1e-12);
  const TurningScene scene = ParseTurningScene(Slit(), "scene.json", File("."));
  int hits = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const RigidMotion motion(PoseOf(path[i]), PoseOf(path[i + 1]));
    for (int k = 0; k <= 50; ++k) {
      const RobotPose pose = motion.At(k / 50.0);
      const Solid turned =
          MakeSolid(Rotated(scene.workspace.robot.mesh(),
                            pose.orientation.toRotationMatrix()),
                    "robot");
      for (const Solid& obstacle : scene.workspace.obstacles) {
        hits += CollisionOracle(turned, obstacle).Collides(pose.position);
      }
    }
  }
  EXPECT_EQ(hits, 0);
  // The page turns the robot as it goes.
  const std::string page = Content(Output("p.html"));
  EXPECT_NE(page.find("\"turns\":[["), std::string::npos);
  // So does one of the rows.
  ASSERT_EQ(Run("view rows.jsonl --html again.html").code, 0);
  EXPECT_NE(Content(Output("again.html")).find("\"turns\":[["),
            std::string::npos);
  const Outcome glb = Run("view rows.jsonl --glb no.glb");
  EXPECT_EQ(glb.code, 2);
  EXPECT_NE(glb.err.find("--glb: expected paths that do not turn"),
            std::string::npos)
      << glb.err;
}

TEST_F(CliTurning, OptimizesThePathOfAPlank) {
  const Outcome outcome = Run("optimize " + Write(Slit()) +
                              " --start planner --time 60 --output rows.jsonl");
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  const Json row = Json::parse(Content(Output("rows.jsonl")));
  EXPECT_EQ(row["collision_free"], true);
  EXPECT_LE(row["path_length"].get<double>(),
            row["planned_length"].get<double>());
  EXPECT_GE(row["rounds"], 1);
  const Json& path = row["path"];
  EXPECT_EQ(path.front(), row["start"]);
  EXPECT_EQ(path.back(), row["goal"]);
  const TurningScene scene = ParseTurningScene(Slit(), "scene.json", File("."));
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    for (const Solid& obstacle : scene.workspace.obstacles) {
      EXPECT_TRUE(RigidJudge(scene.workspace.robot.mesh(), obstacle.mesh())
                      .Check(RigidMotion(PoseOf(path[i]), PoseOf(path[i + 1])))
                      .IsFree());
    }
  }
}

TEST_F(CliTurning, SaysWhichEndCollides) {
  Json scene = Slit();
  scene["start"] = {0, 0, 0};
  const Outcome outcome = Run("plan " + Write(scene) + " --json");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const Json row = Json::parse(outcome.out);
  EXPECT_EQ(row["status"], "start_in_collision");
  EXPECT_FALSE(row["reason"].get<std::string>().empty());
  // Turned, it lies in the slit.
  scene["start_rotation"] = {{"axis", {0, 0, 1}}, {"degrees", 90}};
  scene["goal"] = scene["start"];
  scene["goal_rotation"] = scene["start_rotation"];
  EXPECT_EQ(Run("plan " + Write(scene)).code, 0);
}

TEST_F(CliTurning, RefusesWhatOnlyTranslatingRobotsHave) {
  const std::string plan = "plan " + Write(Slit());
  ExpectRefused(plan + " --planner rrt", {"--planner"});
  ExpectRefused(plan + " --planner contact-surface",
                {"--planner", "none for a robot that turns"});
  ExpectRefused(plan + " --time 0", {"time"});
  ExpectRefused("compare ../scene.json", {"/robot/turns", "phongpd plan"});
  for (const char* flag : {"--metric phong", "--limits 1,1,1", "--margin 0.1",
                           "--model full", "--rows 2"}) {
    ExpectRefused("optimize ../scene.json " + std::string(flag),
                  {std::string(flag).substr(0, std::string(flag).find(' ')),
                   "none for a robot that turns"});
  }
  Json scene = Slit();
  scene["limits"] = {{"velocity", 1}, {"acceleration", 1}, {"jerk", 1}};
  ExpectRefused("plan " + Write(scene), {"/limits", "turns"});
  scene = Slit();
  scene["robot"].erase("turns");
  ExpectRefused("plan " + Write(scene), {"/goal_rotation", "turns"});
  scene = Slit();
  scene["goal_rotation"]["axis"] = {0, 0, 0};
  ExpectRefused("plan " + Write(scene), {"/goal_rotation/axis", "direction"});
  scene = Slit();
  scene["planning"]["planner"] = "contact-surface";
  ExpectRefused("plan " + Write(scene), {"/planning/planner", "time_limit"});
}

}  // namespace
}  // namespace phongpd
