// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the whole contact space, its components, and exact motion checks and
// cells on it.
#include "core/contact/free_space_flood.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "core/minkowski/build_cancellation.h"
#include "core/minkowski/build_refusal.h"
#include "problems/shapes/shapes.h"
#include "tests/support/sanitizer.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;
using Outcome = FreeSpaceFlood::Outcome;

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max() / 2;

// Of the triangles in a box.
struct Measures {
  double area = 0.0, volume = 0.0;
  std::vector<std::vector<double>> corners;  // distinct, in order
};

Measures Measure(const TriangleMesh& mesh, const BoundingBox& box) {
  Measures out;
  for (const Triangle& t : mesh.triangles) {
    Vector3d c[3];
    bool is_in = true;
    for (int k = 0; k < 3; ++k) {
      c[k] = mesh.vertices[static_cast<std::size_t>(
          t[static_cast<std::size_t>(k)])];
      is_in = is_in && (c[k].array() >= box.min.array()).all() &&
              (c[k].array() <= box.max.array()).all();
    }
    if (!is_in) continue;
    out.area += 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
    out.volume += c[0].dot(c[1].cross(c[2])) / 6.0;
    for (const Vector3d& x : c) out.corners.push_back({x[0], x[1], x[2]});
  }
  std::sort(out.corners.begin(), out.corners.end());
  out.corners.erase(std::unique(out.corners.begin(), out.corners.end()),
                    out.corners.end());
  return out;
}

// The cavity's wall comes out as a full build has it, from whichever end it was
// found, however the rest is: the same corners, area and volume.
TEST(FreeSpaceFlood, EnclosesACavityByTheFullBuildsShell) {
  const BoundingBox about{Vector3d::Constant(-1.5), Vector3d::Constant(1.5)};
  const struct {
    TriangleMesh robot, obstacle;
  } pairs[] = {
      {Cube(1), MakeVessel(4, 3, 0)},
      {MakeIcoBall(0.5, 2), MakeVessel(4, 3, 0)},
      {MakeStar(0.3, 0.7), Rotated(MakeVessel(4, 3, 0), GenericRotation())},
  };
  int shells = 0;
  for (const auto& pair : pairs) {
    const ContactSpace whole = BuildContactSpace(pair.robot, pair.obstacle);
    const Measures expected = Measure(whole.mesh(), about);
    ASSERT_LT(expected.volume, 0.0);  // seen from outside
    const ConvolutionModel model(pair.robot, pair.obstacle);
    for (const bool is_start : {true, false}) {
      const Vector3d in(0.01, 0.02, 0.03), out(5, 1, 2);
      FreeSpaceFlood flood(model, is_start ? in : out, is_start ? out : in);
      const Outcome outcome = flood.Explore(kAll);
      ASSERT_TRUE(outcome == Outcome::kStartEnclosed ||
                  outcome == Outcome::kGoalEnclosed);
      if (outcome !=
          (is_start ? Outcome::kStartEnclosed : Outcome::kGoalEnclosed)) {
        continue;  // the outside was smaller
      }
      ++shells;
      const ContactSpace shell = flood.EnclosingSurface();
      const Measures found = Measure(shell.mesh(), about);
      EXPECT_EQ(found.corners, expected.corners);
      EXPECT_NEAR(found.area, expected.area, 1e-12 * expected.area);
      EXPECT_NEAR(found.volume, expected.volume, -1e-12 * expected.volume);
      EXPECT_EQ(Measure(shell.mesh(), shell.bounds()).corners.size(),
                found.corners.size());
    }
  }
  EXPECT_GE(shells, 3);
}

// Whatever was explored: free of its surface is free, and both ends are.
TEST(FreeSpaceFlood, ItsSurfaceBoundsFreeSpaceAtEveryStep) {
  const TriangleMesh robot = MakeStar(0.3, 0.7);
  const TriangleMesh obstacle =
      Rotated(MakeVessel(3.6, 3, 0.6), GenericRotation());
  const FreeSpace truth({BuildContactSpace(robot, obstacle)});
  const ConvolutionModel model(robot, obstacle);
  FreeSpaceFlood flood(model, {0, 0, 0}, {3, 1, 2});
  long free = 0, last = 0;
  std::size_t faces = 0;
  for (int step = 0; step < 12; ++step) {
    const Outcome outcome = flood.Explore(500);
    EXPECT_GE(flood.faces(), faces);
    faces = flood.faces();
    const FreeSpace explored({flood.Surface()});
    EXPECT_TRUE(explored.IsFree(flood.start()));
    EXPECT_TRUE(explored.IsFree(flood.goal()));
    last = free;
    free = 0;
    std::mt19937_64 same(9);
    for (int i = 0; i < 2000; ++i) {
      const Vector3d q = testing::RandomPoint(model.bounds(), &same);
      if (!explored.IsFree(q)) continue;
      ++free;
      EXPECT_TRUE(truth.IsFree(q)) << q.transpose();
    }
    EXPECT_GE(free, last);
    if (outcome == Outcome::kStartEnclosed) break;
  }
  EXPECT_GT(free, 0);
}

// All of it explored, its surface is that of free space.
TEST(FreeSpaceFlood, ExploredToTheEndItIsAllOfFreeSpace) {
  const TriangleMesh robot = MakeIcoBall(0.3, 1);
  const TriangleMesh obstacle = MakeKnot(0.9, 0.15, 40, 6);
  const ContactSpace whole = BuildContactSpace(robot, obstacle);
  const FreeSpace truth({whole});
  const ConvolutionModel model(robot, obstacle);
  FreeSpaceFlood flood(model, {0, 0, 3}, {0.1, 0.2, -3});
  EXPECT_EQ(flood.Explore(kAll), Outcome::kMet);
  EXPECT_EQ(flood.Explore(kAll), Outcome::kStartEnclosed);
  const FreeSpace found({flood.Surface()});
  std::mt19937_64 random(5);
  int free = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d q = testing::RandomPoint(whole.bounds(), &random)
                           .cwiseMax(whole.bounds().min)
                           .cwiseMin(whole.bounds().max);
    ASSERT_EQ(found.IsFree(q), truth.IsFree(q)) << q.transpose();
    free += found.IsFree(q) ? 1 : 0;
  }
  EXPECT_GT(free, 1000);
  EXPECT_LT(free, 19000);
}

TEST(FreeSpaceFlood, TakesFarEndsFromTheNearestPlaceAround) {
  const ConvolutionModel model(Cube(1), Cube(2));
  const FreeSpaceFlood flood(model, {1e6, 0.25, 0}, {1.55, 0.25, 0});
  EXPECT_LT((flood.start() - Vector3d(1.5, 0.25, 0)).norm(), 0.5);
  EXPECT_TRUE(model.IsFree({1e6, 0.25, 0}, flood.start()));
  EXPECT_EQ(flood.goal(), Vector3d(1.55, 0.25, 0));
}

TEST(FreeSpaceFlood, StopsAtTheModelsLimitsAndWhenCancelled) {
  const TriangleMesh knot = MakeKnot(1.0, 0.2, 96, 24);
  const Vector3d start(0, 0, 9), goal(0, 0, -9);
  const auto explore_all = [](FreeSpaceFlood* flood) {
    flood->Explore(kAll);  // until both ends meet
    flood->Explore(kAll);
  };
  ContactSpaceOptions options;
  // Each, enough for the model; where freed memory is kept back it is not.
  options.max_mib = testing::kIsSanitized ? 1e4 : 24.0;
  const ConvolutionModel model(knot, knot, options);
  FreeSpaceFlood large(model, start, goal);
  if (!testing::kIsSanitized) {
    EXPECT_THROW(explore_all(&large), BuildRefusal);
  }
  EXPECT_NO_THROW(FreeSpaceFlood(model, start, goal).Explore(1));

  FreeSpaceFlood cancelled(ConvolutionModel(knot, knot), start, goal);
  CancelBuilds();
  EXPECT_THROW(explore_all(&cancelled), BuildCancelled);
}

}  // namespace
}  // namespace phongpd
