// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: exact distances by DepthQuery, which shares nothing with the judge
// of motions; and paths known by construction.
#include "problems/scenes/rigid_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "constraints/rigid/rigid_judge.h"
#include "core/solid/solid.h"
#include "problems/scenes/scene_shapes.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

// The default of each family, and how tight it gets.
std::vector<std::string> Names() {
  std::vector<std::string> names = {
      "peg:0.001",  "peg:1e-05",   "ell:2",     "lock:0.001", "rod_trap:0.01",
      "piano:0.01", "flange:0.02", "alpha:1.1", "alpha:3"};
  for (const RigidSceneFamily& f : RigidSceneFamilies()) {
    names.push_back(f.name);
  }
  return names;
}

RigidJudge JudgeOf(const RigidScene& scene) {
  return RigidJudge({scene.robot}, scene.obstacles);
}

// The exact query's answer for the obstacle that is nearest.
Depth Nearest(const RigidScene& scene, const RobotPose& pose) {
  std::vector<Depth> depths;
  for (const TriangleMesh& obstacle : scene.obstacles) {
    depths.push_back(PenetrationDepth(scene.robot, obstacle, pose));
  }
  return *std::min_element(depths.begin(), depths.end(),
                           [](const Depth& a, const Depth& b) {
                             return a.SignedDistance() < b.SignedDistance();
                           });
}

TEST(RigidScenes, AreSolidsThatKeepApart) {
  for (const std::string& name : Names()) {
    const RigidScene scene = MakeRigidScene(name);
    SCOPED_TRACE(name);
    MeshReport report;
    MakeSolid(scene.robot, "robot", &report);
    EXPECT_EQ(report.inverted_components, 0);
    for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
      MakeSolid(scene.obstacles[i], "obstacle", &report);
      EXPECT_EQ(report.inverted_components, 0);
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_EQ(
            PenetrationDepth(scene.obstacles[i], scene.obstacles[j]).status,
            DepthStatus::kSeparate);
      }
    }
  }
}

TEST(RigidScenes, HaveFreeEndsWithinTheBounds) {
  for (const std::string& name : Names()) {
    const RigidScene scene = MakeRigidScene(name);
    const RigidJudge judge = JudgeOf(scene);
    for (const RobotPose& pose : {scene.start, scene.goal, scene.narrow}) {
      EXPECT_TRUE(judge.Check(RigidMotion(pose, pose)).IsFree()) << name;
      EXPECT_TRUE((pose.position.array() >= scene.bounds.min.array()).all() &&
                  (pose.position.array() <= scene.bounds.max.array()).all())
          << name;
    }
    // They are problems: nothing goes straight.
    EXPECT_FALSE(judge.Check(RigidMotion(scene.start, scene.goal)).IsFree())
        << name;
  }
}

TEST(RigidScenes, KeepTheStatedDistanceInTheNarrowPlace) {
  for (const std::string& name : Names()) {
    const RigidScene scene = MakeRigidScene(name);
    const Depth depth = Nearest(scene, scene.narrow);
    EXPECT_EQ(depth.status, DepthStatus::kSeparate) << name;
    // That query rounds coordinates to a grid, and says by how much.
    EXPECT_NEAR(depth.clearance, scene.clearance, 7 * depth.grid_step + 1e-13)
        << name;
    EXPECT_LT(depth.grid_step, 1e-10) << name;
    EXPECT_GT(scene.clearance, 0.0) << name;
  }
}

TEST(RigidScenes, HaveTheirWitnesses) {
  int witnesses = 0;
  for (const std::string& name : Names()) {
    const RigidScene scene = MakeRigidScene(name);
    if (scene.witness.empty()) continue;
    ++witnesses;
    const RigidJudge judge = JudgeOf(scene);
    for (std::size_t i = 1; i < scene.witness.size(); ++i) {
      EXPECT_TRUE(
          judge.Check(RigidMotion(scene.witness[i - 1], scene.witness[i]))
              .IsFree())
          << name << ' ' << i;
    }
  }
  EXPECT_GE(witnesses, 10);
}

TEST(SceneShapes, HaveTubes) {
  const auto shape = nlohmann::ordered_json::parse(
      R"({"type": "tube", "path": [[0, 0, 0], [2, 0, 0], [3, 1, 0.5]],
          "radius": 0.25, "sides": 6})");
  const TriangleMesh tube =
      MakeTube({{0, 0, 0}, {2, 0, 0}, {3, 1, 0.5}}, 0.25, 6);
  EXPECT_EQ(MakeShape(shape, "here").vertices, tube.vertices);
  EXPECT_EQ(MakeShape(shape, "here").triangles, tube.triangles);
}

TEST(RigidScenes, AreNamedByFamilyAndValue) {
  EXPECT_EQ(MakeRigidScene("peg").name, "peg:0.1");
  EXPECT_EQ(MakeRigidScene("alpha:1.25").name, "alpha:1.25");
  EXPECT_EQ(RigidSceneFamilies().size(), 8u);
  const auto refusal = [](const char* name) -> std::string {
    return testing::ErrorOf([&] { MakeRigidScene(name); }, "accepted");
  };
  EXPECT_EQ(refusal("aplha").rfind("rigid scene: expected one of window, ", 0),
            0u);
  EXPECT_NE(refusal("aplha").find("did you mean alpha?"), std::string::npos);
  EXPECT_EQ(refusal("alpha:1"),
            "rigid scene alpha: gap where a tube crosses itself, over its "
            "thickness: expected a number in [1.01, 3], found 1");
  EXPECT_EQ(refusal("peg:x"),
            "rigid scene peg: expected a finite number, found 'x'");
  EXPECT_EQ(refusal("peg:"),
            "rigid scene peg: expected a finite number, found ''");
}

}  // namespace
}  // namespace phongpd
