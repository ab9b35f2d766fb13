// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/world/scene_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "core/mesh/mesh_error.h"
#include "core/solid/mesh_check.h"
#include "problems/shapes/random_solids.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

Json Box(const std::string& id, const Vector3d& size, const Vector3d& center) {
  return {
      {"id", id},
      {"shape", {{"type", "box"}, {"size", {size.x(), size.y(), size.z()}}}},
      {"position", {center.x(), center.y(), center.z()}}};
}

// Overlapping, touching and single obstacles, one through a face of the
// bounds, one out of reach.
Json Crowd() {
  return {
      {"name", "crowd"},
      {"robot",
       {{"shape", {{"type", "ball"}, {"radius", 0.15}, {"triangles", 80}}}}},
      {"obstacles",
       {Box("wall", {0.2, 1.0, 1.0}, {0.0, 0.0, 0.0}),
        Box("bar", {1.0, 0.2, 0.2}, {0.3, 0.1, 0.1}),
        Box("brick", {0.2, 0.2, 0.2}, {0.2, -0.3, -0.4}),
        Box("beam", {0.3, 0.3, 2.0}, {-0.6, 0.6, 0.9}),
        Box("far", {1.0, 1.0, 1.0}, {3.0, 0.0, 0.0})}},
      {"bounds", {{"min", {-1, -1, -1}}, {"max", {1, 1, 1}}}},
      {"start", {-0.8, -0.8, -0.8}},
      {"goal", {0.8, -0.8, 0.8}}};
}

Scene Parse(const Json& json) { return ParseScene(json, "crowd.json"); }

class SceneSpaceLayouts : public testing::TestWithParam<SpaceLayout> {};

TEST_P(SceneSpaceLayouts, AgreeWithFclOnFreedom) {
  const Scene scene = Parse(Crowd());
  const SceneSpace space = BuildSceneSpace(scene, GetParam());
  std::vector<CollisionOracle> oracles;
  for (const Obstacle& obstacle : scene.workspace.obstacles) {
    oracles.emplace_back(scene.workspace.robot, obstacle.mesh);
  }
  std::mt19937_64 random(5);
  int free = 0, beyond = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d q = RandomPoint(
        {Vector3d::Constant(-1.2), Vector3d::Constant(1.2)}, &random);
    const bool is_within = q.cwiseAbs().maxCoeff() < 1.0;
    const bool is_free =
        is_within && std::none_of(oracles.begin(), oracles.end(),
                                  [&](const CollisionOracle& oracle) {
                                    return oracle.Collides(q);
                                  });
    EXPECT_EQ(space.free_space->IsFree(q), is_free) << q.transpose();
    free += is_free;
    beyond += !is_within;
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(beyond, 1000);
}

TEST_P(SceneSpaceLayouts, HaveOneDiagonalAndOneSealedMesh) {
  const Scene scene = Parse(Crowd());
  const SceneSpace space = BuildSceneSpace(scene, GetParam());
  EXPECT_EQ(space.diagonal, ContactBounds(scene.workspace).Diagonal());
  std::size_t triangles = 0;
  for (const ContactSpace& one : space.contact_spaces) {
    EXPECT_EQ(one.length(), space.diagonal);
    triangles += one.mesh().triangles.size();
  }
  EXPECT_EQ(space.triangles, triangles);
  EXPECT_EQ(space.contact_spaces.size(),
            GetParam() == SpaceLayout::kPerObstacle ? 4U : 1U);
  // Closed around the bounds: nothing beyond them is free of it but the
  // unbounded outside of the shell.
  const MeshReport report = ExamineMesh(space.sealed->mesh());
  EXPECT_EQ(report.boundary_edges, 0U);
  EXPECT_EQ(report.non_manifold_edges, 0U);
  const FreeSpace sealed({*space.sealed});
  EXPECT_TRUE(sealed.IsFree(scene.start));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vector3d q(-0.8, -0.8, -0.8);
      q[axis] = side * 0.999999;
      EXPECT_TRUE(sealed.IsFree(q)) << q.transpose();
      q[axis] = side * 1.000001;
      EXPECT_FALSE(sealed.IsFree(q)) << q.transpose();
      Vector3d out = q;
      out[axis] = side * 100.0;
      EXPECT_FALSE(sealed.IsFree(scene.start, out));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SceneSpaceLayouts,
                         testing::Values(SpaceLayout::kMerged,
                                         SpaceLayout::kPerObstacle,
                                         SpaceLayout::kSealed));

TEST(SceneSpace, SkipsObstaclesOutOfReachAndSaysSo) {
  const Scene scene = Parse(Crowd());
  const std::string note = SkippedObstaclesNote(scene);
  EXPECT_NE(note.find("far"), std::string::npos) << note;
  EXPECT_EQ(note.find("beam"), std::string::npos) << note;
  Json near = Crowd();
  near["obstacles"].erase(4);
  EXPECT_TRUE(SkippedObstaclesNote(Parse(near)).empty());
  const SceneSpace all = BuildSceneSpace(scene);
  const SceneSpace few = BuildSceneSpace(Parse(near));
  EXPECT_EQ(all.contact_spaces[0].mesh().vertices,
            few.contact_spaces[0].mesh().vertices);
  EXPECT_EQ(all.contact_spaces[0].mesh().triangles,
            few.contact_spaces[0].mesh().triangles);
}

TEST(SceneSpace, NeedsNoObstacleWithinReach) {
  Json json = Crowd();
  json["obstacles"] = {Box("far", {1.0, 1.0, 1.0}, {30.0, 0.0, 0.0})};
  for (const SpaceLayout layout :
       {SpaceLayout::kMerged, SpaceLayout::kPerObstacle,
        SpaceLayout::kSealed}) {
    const Scene scene = Parse(json);
    const SceneSpace space = BuildSceneSpace(scene, layout);
    EXPECT_TRUE(space.free_space->IsFree(scene.start, scene.goal));
    EXPECT_FALSE(space.free_space->IsFree(scene.start, {1.5, 0.0, 0.0}));
  }
  json.erase("bounds");  // within reach, then
  EXPECT_EQ(BuildSceneSpace(Parse(json)).contact_spaces.size(), 1U);
}

TEST(SceneSpace, WithoutBoundsSealsNothing) {
  Json json = Crowd();
  json.erase("bounds");
  const SceneSpace space = BuildSceneSpace(Parse(json));
  ASSERT_EQ(space.contact_spaces.size(), 1U);
  EXPECT_TRUE(space.sealed->SharesWith(space.contact_spaces[0]));
  EXPECT_TRUE(space.free_space->IsFree({50.0, 50.0, 50.0}));
}

// The way out of the sealed mesh leads beyond the bounds' shell, too: its
// depth once was that of the shell.
TEST(EndInCollision, TellsTheSameInEveryLayout) {
  Json json = Crowd();
  json["robot"]["shape"] = {{"type", "box"}, {"size", {4.0, 4.0, 4.0}}};
  const Scene scene = Parse(json);
  const Vector3d inside(0.5, 0.0, 0.0);
  const std::string merged =
      EndInCollision(scene, BuildSceneSpace(scene), inside, "start");
  EXPECT_EQ(merged.find("start (0.5,0,0) is "), 0U) << merged;
  EXPECT_NE(merged.find("wall"), std::string::npos) << merged;
  const SceneSpace sealed = BuildSceneSpace(scene, SpaceLayout::kSealed);
  EXPECT_EQ(EndInCollision(scene, sealed, inside, "start"), merged);
}

TEST(EndInCollision, NamesObstacleAndDepthOrTheBounds) {
  const Scene scene = Parse(Crowd());
  for (const SpaceLayout layout :
       {SpaceLayout::kMerged, SpaceLayout::kPerObstacle,
        SpaceLayout::kSealed}) {
    const SceneSpace space = BuildSceneSpace(scene, layout);
    // The beam is 0.3 wide and the ball's facets lie within its radius.
    const std::string text =
        EndInCollision(scene, space, {-0.6, 0.6, 0.9}, "goal");
    EXPECT_EQ(text.find("goal (-0.6,0.6,0.9) is 0.3 deep in beam"), 0U) << text;
    EXPECT_EQ(EndInCollision(scene, space, {1.0, 0.0, 0.9}, "goal"),
              "goal (1,0,0.9) is not strictly within the bounds");
  }
}

}  // namespace
}  // namespace phongpd
