// SPDX-License-Identifier: GPL-3.0-or-later
// phongpd plan of a robot that turns: a plank that lies across the slit it has
// to pass.  Truth: FCL at many poses of the path that was written.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "constraints/rigid/rigid_judge.h"
#include "constraints/rigid/rigid_motion.h"
#include "problems/scenes/rigid_scenes.h"
#include "problems/scenes/turning_scene.h"
#include "tests/problems/cli/cli_fixture.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

class CliTurning : public Cli {
 protected:
  using Json = nlohmann::ordered_json;

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
      const Solid turned = MakeSolid(
          Rotated(scene.robot, pose.orientation.toRotationMatrix()), "robot");
      for (const TurningScene::Obstacle& obstacle : scene.obstacles) {
        const Solid solid = MakeSolid(obstacle.mesh, obstacle.name);
        hits += CollisionOracle(turned, solid).Collides(pose.position);
      }
    }
  }
  EXPECT_EQ(hits, 0);
  const double lower = row["clearance"]["lower"].get<double>();
  EXPECT_GT(lower, 0.0);
  EXPECT_GE(row["clearance"]["upper"].get<double>(), lower);
  EXPECT_LT(row["clearance"]["motion"].get<std::size_t>(), path.size() - 1);
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

TEST_F(CliTurning, RowsAreTheSameButForTimesByAsManyThreads) {
  const std::string plan = "plan " + Write(Slit()) + " --seed 3 --json";
  const auto row = [&](const std::string& flags) {
    Json found = Json::parse(Run(plan + flags).out);
    found.erase("seconds");
    return found;
  };
  EXPECT_EQ(row("")["threads"], 2);
  EXPECT_EQ(row(""), row(" --threads 2"));
  const Json three = row(" --threads 3");
  EXPECT_EQ(three["threads"], 3);
  EXPECT_EQ(three, row(" --threads 3"));
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
    for (const TurningScene::Obstacle& obstacle : scene.obstacles) {
      EXPECT_TRUE(RigidJudge(scene.robot, obstacle.mesh)
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
  ExpectRefused(plan + " --threads 0", {"--threads", "1 to 64", "found 0"});
  ExpectRefused("plan u_axis --threads 2", {"--threads", "a robot that turns"});
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

TEST_F(CliTurning, FamiliesArePlannedWrittenAndShown) {
  ExpectRefused("plan alpha:1", {"alpha", "[1.01, 3]", "found 1"});
  ExpectRefused("plan alpha:play=2", {"alpha", "gap", "'play'"});
  ExpectRefused("compare alpha", {"turns"});
  ExpectRefused("view alpha --build --html v.html", {"--build", "turns"});
  const Json list = Json::parse(Run("scenes list --json").out);
  ASSERT_EQ(list["turning_families"].size(), 8U);
  const std::string words = Run("scenes list").out;
  for (const Json& family : list["turning_families"]) {
    const std::string name = family["name"];
    ASSERT_EQ(family["knobs"].size(), 1U) << name;
    EXPECT_NE(words.find("\n" + name + ": "), std::string::npos) << name;
    // Its file is the scene that the family is.
    ASSERT_EQ(Run("scenes write " + name + " --output s.json").code, 0) << name;
    const std::string text = Content(Output("s.json"));
    const TurningScene file = ParseTurningSceneFile(text, "s.json");
    const RigidScene made = MakeRigidScene(name);
    EXPECT_EQ(file.robot.vertices, made.robot.vertices) << name;
    EXPECT_EQ(file.robot.triangles, made.robot.triangles) << name;
    ASSERT_EQ(file.obstacles.size(), made.obstacles.size()) << name;
    for (std::size_t i = 0; i < made.obstacles.size(); ++i) {
      EXPECT_EQ(file.obstacles[i].mesh.vertices, made.obstacles[i].vertices);
    }
    EXPECT_EQ(file.start.position, made.start.position) << name;
    EXPECT_LT(file.goal.orientation.angularDistance(made.goal.orientation),
              1e-7)
        << name;
    EXPECT_TRUE(file.warnings.empty()) << name << file.warnings.front();
    const Outcome view = Run("view " + name + " --html v.html --json");
    ASSERT_EQ(view.code, 0) << name << view.err;
    EXPECT_EQ(Json::parse(view.out)["robot_triangles"],
              made.robot.triangles.size())
        << name;
  }
  const Outcome plan =
      Run("plan window:4 --time 60 --output w.jsonl --html w.html");
  ASSERT_EQ(plan.code, 0) << plan.err;
  const Json row = Json::parse(Content(Output("w.jsonl")));
  EXPECT_EQ(row["scene"], "window:4");
  EXPECT_EQ(row["path"].front().size(), 7U);
  // A row finds its scene, and so does a file.
  EXPECT_EQ(Run("view w.jsonl --html again.html").code, 0);
  EXPECT_EQ(Run("scenes write peg --set play=0.5 --output p.json").code, 0);
  EXPECT_EQ(Run("view p.json --html p.html").code, 0);
}

// A wall of two triangles has no inside: it is judged, and said to be open.
TEST_F(CliTurning, TakesSurfacesThatAreNotClosed) {
  Json scene = Slit();
  for (const int side : {-1, 1}) {
    Json& wall = scene["obstacles"][side < 0 ? 0 : 1];
    const double a = 0.25 * side, b = 3.25 * side;
    wall["shape"] = {
        {"type", "triangles"},
        {"vertices", {{0, a, -1.5}, {0, b, -1.5}, {0, b, 1.5}, {0, a, 1.5}}},
        {"triangles", {{0, 1, 2}, {0, 2, 3}}}};
    wall.erase("position");
  }
  const Outcome outcome = Run("plan " + Write(scene) + " --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("its triangles are judged as they are"),
            std::string::npos)
      << outcome.err;
  const Json row = Json::parse(outcome.out);
  const TurningScene read = ParseTurningScene(scene, "scene.json");
  EXPECT_EQ(read.warnings.size(), 2U);
  // On the way past x = 0 all of it is within the slit: |y| < 0.25.
  const Json& path = row["path"];
  int crossings = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const RigidMotion motion(PoseOf(path[i]), PoseOf(path[i + 1]));
    for (int k = 0; k <= 200; ++k) {
      const RobotPose pose = motion.At(k / 200.0);
      const std::vector<Vector3d>& v = read.robot.vertices;
      for (std::size_t j = 0; j < v.size(); ++j) {
        for (std::size_t l = 0; l < j; ++l) {
          const Vector3d p = pose.orientation * v[j] + pose.position;
          const Vector3d q = pose.orientation * v[l] + pose.position;
          if (p.x() * q.x() >= 0.0) continue;
          ++crossings;
          const double t = p.x() / (p.x() - q.x());
          EXPECT_LT(std::abs(p.y() + t * (q.y() - p.y())), 0.25);
        }
      }
    }
  }
  EXPECT_GT(crossings, 0);
  // A repair that is asked for has to succeed; others want solids.
  ExpectRefused("plan " + Write(scene) + " --repair safe",
                {"/obstacles/0", "open"});
  scene["robot"].erase("turns");
  scene.erase("goal_rotation");
  ExpectRefused("plan " + Write(scene), {"/obstacles/0"});
  scene = Slit();
  scene["robot"]["shape"] = {{"type", "triangles"},
                             {"vertices", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                             {"triangles", {{0, 1, 3}}}};
  ExpectRefused("plan " + Write(scene),
                {"/robot/shape", "numbers of vertices"});
}

}  // namespace
}  // namespace phongpd
