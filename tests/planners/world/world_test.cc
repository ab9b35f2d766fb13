// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "core/mesh/mesh_error.h"
#include "core/solid/solid.h"
#include "problems/scenes/scene.h"
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

World WorldOf(const Scene& scene) { return World(scene.workspace, scene.name); }

class WorldLayouts : public ::testing::TestWithParam<SpaceLayout> {};

TEST_P(WorldLayouts, AgreeWithFclOnFreedom) {
  const Scene scene = Parse(Crowd());
  const World world = WorldOf(scene);
  const WorldSpaces& space = world.Spaces(GetParam());
  std::vector<CollisionOracle> oracles;
  for (const Solid& obstacle : scene.workspace.obstacles) {
    oracles.emplace_back(scene.workspace.robot, obstacle);
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

TEST_P(WorldLayouts, HaveOneDiagonalAndOneSealedMesh) {
  const Scene scene = Parse(Crowd());
  const World world = WorldOf(scene);
  const WorldSpaces& space = world.Spaces(GetParam());
  EXPECT_EQ(world.diagonal(), ContactBounds(scene.workspace).Diagonal());
  std::size_t triangles = 0;
  for (const TriangleMesh& mesh : space.Meshes()) {
    triangles += mesh.triangles.size();
  }
  EXPECT_EQ(space.triangles, triangles);
  EXPECT_EQ(space.spaces.size(),
            GetParam() == SpaceLayout::kPerObstacle ? 4U : 1U);
  // Closed around the bounds: nothing beyond them is free of it but the
  // unbounded outside of the shell.
  const MeshReport report = ExamineMesh(world.Sealed().mesh());
  EXPECT_EQ(report.boundary_edges, 0U);
  EXPECT_EQ(report.non_manifold_edges, 0U);
  const FreeSpace sealed({world.Sealed()});
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

INSTANTIATE_TEST_SUITE_P(All, WorldLayouts,
                         ::testing::Values(SpaceLayout::kMerged,
                                           SpaceLayout::kPerObstacle,
                                           SpaceLayout::kSealed));

TEST(World, SkipsObstaclesOutOfReachAndSaysSo) {
  const Scene scene = Parse(Crowd());
  const std::string note = SkippedObstaclesNote(scene);
  EXPECT_NE(note.find("far"), std::string::npos) << note;
  EXPECT_EQ(note.find("beam"), std::string::npos) << note;
  Json near = Crowd();
  near["obstacles"].erase(4);
  EXPECT_TRUE(SkippedObstaclesNote(Parse(near)).empty());
  const World all = WorldOf(scene), few = WorldOf(Parse(near));
  const TriangleMesh& a = all.Spaces(SpaceLayout::kMerged).spaces[0].mesh();
  const TriangleMesh& b = few.Spaces(SpaceLayout::kMerged).spaces[0].mesh();
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(World, NeedsNoObstacleWithinReach) {
  Json json = Crowd();
  json["obstacles"] =
      Json::array({Box("far", {1.0, 1.0, 1.0}, {30.0, 0.0, 0.0})});
  const Scene scene = Parse(json);
  const World world = WorldOf(scene);
  for (const SpaceLayout layout :
       {SpaceLayout::kMerged, SpaceLayout::kPerObstacle,
        SpaceLayout::kSealed}) {
    const FreeSpace& space = *world.Spaces(layout).free_space;
    EXPECT_TRUE(space.IsFree(scene.start, scene.goal));
    EXPECT_FALSE(space.IsFree(scene.start, {1.5, 0.0, 0.0}));
  }
  json.erase("bounds");  // within reach, then
  EXPECT_EQ(WorldOf(Parse(json)).Spaces(SpaceLayout::kMerged).spaces.size(),
            1U);
  Workspace nothing;
  nothing.robot = scene.workspace.robot;
  EXPECT_THROW(World{nothing}, InputError);
}

// Without bounds the sealed space is the merged one, and is built once.
TEST(World, WithoutBoundsSealsNothing) {
  Json json = Crowd();
  json.erase("bounds");
  const World world = WorldOf(Parse(json));
  const WorldSpaces& merged = world.Spaces(SpaceLayout::kMerged);
  ASSERT_EQ(merged.spaces.size(), 1U);
  EXPECT_EQ(&world.Sealed(), &merged.spaces[0]);
  EXPECT_EQ(world.Report().contact_spaces, 1);
  EXPECT_TRUE(merged.free_space->IsFree({50.0, 50.0, 50.0}));
}

TEST(World, BuildsOnDemandOnceForAllCopiesAndThreads) {
  const World world = WorldOf(Parse(Crowd()));
  const World copy = world;
  EXPECT_FALSE(world.Diagnose({0.0, 0.0, 0.0}).IsFree());
  EXPECT_TRUE(world.Diagnose({-0.8, -0.8, -0.8}).IsFree());
  EXPECT_EQ(world.Resolve(Length::FromShare(1.0)).unit, world.diagonal());
  EXPECT_EQ(world.Report().contact_spaces, 0);
  EXPECT_EQ(world.Built(SpaceLayout::kSealed), nullptr);
  std::vector<const ContactSpace*> found(4, nullptr);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i) {
    threads.emplace_back(
        [&, i] { found[i] = &(i % 2 == 0 ? world : copy).Sealed(); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const ContactSpace* space : found) EXPECT_EQ(space, &world.Sealed());
  EXPECT_EQ(world.Report().contact_spaces, 1);
  EXPECT_EQ(copy.Built(SpaceLayout::kMerged), nullptr);
  world.Spaces(SpaceLayout::kMerged);
  EXPECT_NE(copy.Built(SpaceLayout::kMerged), nullptr);
  world.Spaces(SpaceLayout::kPerObstacle);
  EXPECT_EQ(world.Report().contact_spaces, 6);
}

// D is the same whatever is built, so that an option means one length.
TEST(World, ItsSpacesMeasureByTheWorldsDiagonal) {
  const World world = WorldOf(Parse(Crowd()));
  int smaller = 0;
  for (const SpaceLayout layout :
       {SpaceLayout::kMerged, SpaceLayout::kPerObstacle,
        SpaceLayout::kSealed}) {
    for (const ContactSpace& space : world.Spaces(layout).spaces) {
      EXPECT_EQ(space.length(), world.diagonal());
      smaller += space.bounds().Diagonal() < 0.5 * world.diagonal();
    }
  }
  EXPECT_GT(smaller, 0);
}

// By the oracle's solids; by free space alone at first, then by the contact
// spaces that somebody built.
TEST(World, TellsWhatIsFreeWithWhateverThereIs) {
  const Scene scene = Parse(Crowd());
  const World world = WorldOf(scene);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> side(-1.2, 1.2);
  std::vector<Vector3d> places;
  for (int i = 0; i < 200; ++i) {
    places.emplace_back(side(random), side(random), side(random));
  }
  std::vector<bool> before;
  int free = 0;
  for (const Vector3d& q : places) {
    before.push_back(world.IsFree({q}));
    EXPECT_EQ(before.back(), world.Diagnose(q).IsFree()) << q.transpose();
    free += before.back();
  }
  EXPECT_GT(free, 20);
  EXPECT_LT(free, 180);
  EXPECT_EQ(world.Built(SpaceLayout::kMerged), nullptr);
  std::vector<bool> motions;
  for (std::size_t i = 1; i < places.size(); ++i) {
    motions.push_back(world.IsFree({places[i - 1], places[i]}));
  }
  world.Spaces(SpaceLayout::kMerged);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(world.IsFree({places[i]}), before[i]);
    if (i == 0) continue;
    EXPECT_EQ(world.IsFree({places[i - 1], places[i]}), motions[i - 1]);
  }
  EXPECT_FALSE(world.IsFree({}));
  EXPECT_FALSE(world.IsFree({Vector3d(NAN, 0.0, 0.0)}));
  EXPECT_FALSE(
      world.IsFree({Vector3d(-0.8, -0.8, -0.8), Vector3d(0.0, INFINITY, 0.0)}));
}

TEST(World, IsKnownByItsSolidsNamesAndBounds) {
  const Workspace a = Parse(Crowd()).workspace;
  Workspace b = a;
  EXPECT_TRUE(HaveSameSolids(a, b));
  b.obstacles[1] = b.obstacles[1].Named("rod");
  EXPECT_FALSE(HaveSameSolids(a, b));
  b = a;
  TriangleMesh moved = b.obstacles[1];
  moved.vertices[0].x() += 1e-15;
  b.obstacles[1] = MakeSolid(moved, b.obstacles[1].name());
  EXPECT_FALSE(HaveSameSolids(a, b));
  b = a;
  b.bounds.max.x() += 1.0;
  EXPECT_FALSE(HaveSameSolids(a, b));
}

// What planners make of a world: once for each tag and type, the last ones.
TEST(World, KeepsWhatIsMadeOfItByTypeAndTag) {
  const World world = WorldOf(Parse(Crowd()));
  const World copy = world;
  int made = 0;
  const auto number = [&](const World& of, int value) {
    return *of.Kept<int>(std::to_string(value), [&] {
      ++made;
      return value;
    });
  };
  EXPECT_EQ(number(world, 7), 7);
  EXPECT_EQ(number(copy, 7), 7);
  EXPECT_EQ(made, 1);
  EXPECT_EQ(*world.Kept<std::string>("7", [] { return std::string("a"); }),
            "a");
  EXPECT_EQ(number(world, 7), 7);
  EXPECT_EQ(made, 1);
  // Of too many the first go, and live as long as somebody has them.
  const auto held = world.Kept<int>("7", [] { return -1; });
  for (int k = 0; k < static_cast<int>(World::kMostKept); ++k) {
    number(world, 100 + k);
  }
  EXPECT_EQ(*held, 7);
  made = 0;
  number(world, 7);
  EXPECT_EQ(made, 1);
  // What is thrown is kept by nobody.
  const auto fail = []() -> int { throw InputError("not today"); };
  EXPECT_THROW(world.Kept<int>("bad", fail), InputError);
  EXPECT_EQ(*world.Kept<int>("bad", [] { return 3; }), 3);
}

TEST(World, MakesOnceForAllThreadsThatAsk) {
  const World world = WorldOf(Parse(Crowd()));
  std::atomic<int> made{0};
  std::vector<std::thread> threads;
  std::vector<std::shared_ptr<const int>> seen(8);
  for (std::shared_ptr<const int>& one : seen) {
    threads.emplace_back([&] {
      one = world.Kept<int>("", [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return ++made;
      });
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
  for (const auto& one : seen) EXPECT_EQ(one, seen.front());
}

}  // namespace
}  // namespace phongpd
