// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: FCL on the original meshes, densely along motions, and closed forms.
#include "constraints/free_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "constraints/oracle/collision_oracle.h"
#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"
#include "tests/support/around_cube.h"
#include "tests/support/oracle_of.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::AroundCube;
using testing::Cube;

TEST(FreeSpace, IsOpen) {
  const BoundingBox bounds = {Vector3d::Constant(-3.0),
                              Vector3d::Constant(3.0)};
  const FreeSpace space = AroundCube(bounds);
  const double ulp = std::numeric_limits<double>::epsilon();
  EXPECT_FALSE(space.IsFree({0.0, 0.0, 0.0}));
  EXPECT_FALSE(space.IsFree({1.0, 0.2, 0.3}));
  EXPECT_TRUE(space.IsFree({1.0 + ulp, 0.2, 0.3}));
  EXPECT_FALSE(space.IsFree({3.0, 0.0, 0.0}));
  EXPECT_TRUE(space.IsFree({3.0 - 2.0 * ulp, 0.0, 0.0}));
  EXPECT_FALSE(space.IsFree({std::nan(""), 2.0, 0.0}));
}

TEST(FreeSpace, FindsTheFirstContactOfAMotion) {
  const FreeSpace space = AroundCube();
  MotionCheck check = space.Check({-2.0, 0.3, 0.1}, {2.0, 0.3, 0.1});
  EXPECT_FALSE(check.free);
  EXPECT_DOUBLE_EQ(check.fraction, 0.25);
  EXPECT_EQ(check.obstacle, 0);
  EXPECT_GE(check.triangle, 0);
  // Along a face: touching is not free, an ulp beside it is.
  EXPECT_FALSE(space.IsFree({-2.0, 1.0, 0.0}, {2.0, 1.0, 0.0}));
  const double beside = std::nextafter(1.0, 2.0);
  EXPECT_TRUE(space.IsFree({-2.0, beside, 0.0}, {2.0, beside, 0.0}));
  // From inside, and wholly inside.
  check = space.Check({0.0, 0.0, 0.0}, {0.5, 0.0, 0.0});
  EXPECT_FALSE(check.free);
  EXPECT_EQ(check.fraction, 0.0);
  EXPECT_EQ(check.obstacle, 0);
}

TEST(FreeSpace, StopsAtTheBounds) {
  const BoundingBox bounds = {Vector3d::Constant(-3.0),
                              Vector3d::Constant(3.0)};
  const FreeSpace space = AroundCube(bounds);
  const MotionCheck check = space.Check({2.0, 2.0, 2.0}, {6.0, 2.5, 2.0});
  EXPECT_FALSE(check.free);
  EXPECT_DOUBLE_EQ(check.fraction, 0.25);
  EXPECT_EQ(check.obstacle, MotionCheck::kBounds);
  EXPECT_EQ(space.Check({4.0, 0.0, 0.0}, {2.0, 0.0, 0.0}).fraction, 0.0);
}

TEST(FreeSpace, SeesThinObstaclesThatSamplesMiss) {
  const TriangleMesh wall = MakeBox({-1e-9, -1.0, -1.0}, {1e-9, 1.0, 1.0});
  const FreeSpace space({BuildContactSpace(Cube(1e-9), wall)});
  EXPECT_TRUE(space.IsFree({-0.5, 0.0, 0.0}));
  EXPECT_TRUE(space.IsFree({0.5, 0.1, 0.0}));
  EXPECT_FALSE(space.IsFree({-0.5, 0.0, 0.0}, {0.5, 0.1, 0.0}));
}

TEST(FreeSpace, AgreesWithDenseChecksOfTheOriginalMeshes) {
  std::mt19937_64 random(7);
  const TriangleMesh robot = MakeStar(0.2, 0.5);
  const TriangleMesh obstacle =
      Rotated(MakeTorus(1.0, 0.3, 16, 8), testing::RandomRotation(&random));
  const ContactSpace contact = BuildContactSpace(robot, obstacle);
  const FreeSpace space({contact});
  const auto oracle = testing::OracleOf<CollisionOracle>(robot, obstacle);
  BoundingBox box = ComputeBounds(contact.mesh());
  box.min *= 1.3;
  box.max *= 1.3;
  int free = 0, blocked = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d a = testing::RandomPoint(box, &random);
    const Vector3d b = testing::RandomPoint(box, &random);
    const MotionCheck check = space.Check(a, b);
    ASSERT_EQ(check.free, space.IsFree(a, b));
    const int steps = 60;
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      // At the first contact itself either answer is right.
      if (!check.free && t > check.fraction - 1e-9) break;
      ASSERT_FALSE(oracle.Collides(a + t * (b - a))) << i << " at " << t;
    }
    if (!check.free && space.IsFree(a)) {
      const Vector3d at = a + check.fraction * (b - a);
      EXPECT_LT(space.Clearance(at), 1e-12 * box.Diagonal());
    }
    (check.free ? free : blocked) += 1;
  }
  EXPECT_GT(free, 50);
  EXPECT_GT(blocked, 50);
}

// Truth: every triangle by itself, the nearest first; how far it is, by its own
// tree.
std::vector<Separator> SeparatorsByForce(const TriangleMesh& mesh,
                                         const Vector3d& a, const Vector3d& b,
                                         double radius, double slack) {
  std::vector<Separator> all, kept;
  for (const Triangle& t : mesh.triangles) {
    const std::array<Vector3d, 3> corners = {
        mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const TriangleBvh alone(
        TriangleMesh{{corners.begin(), corners.end()}, {{0, 1, 2}}});
    const double distance = alone.Distance(a, b, 2.0 * radius);
    if (!(distance <= radius)) continue;
    all.push_back(SeparatorOf(corners, a, b));
    EXPECT_NEAR(all.back().distance, distance, 1e-12);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Separator& one, const Separator& other) {
                     return one.distance < other.distance;
                   });
  for (const Separator& one : all) {
    const bool is_hidden =
        std::any_of(kept.begin(), kept.end(), [&](const Separator& plane) {
          return std::all_of(
              one.corners.begin(), one.corners.end(), [&](const Vector3d& q) {
                return plane.normal.dot(q) <= plane.level + slack;
              });
        });
    if (!is_hidden) kept.push_back(one);
  }
  return kept;
}

TEST(FreeSpace, FindsTheSeparatorsOfASegment) {
  for (const Vector3d& place : {Vector3d(0, 0, 0), Vector3d(1000, 0, 0)}) {
    const TriangleMesh mesh = Translated(MakeTorus(1.0, 0.3, 24, 12), place);
    const FreeSpace space({TakeAsContactSpace(mesh)});
    std::mt19937_64 random(11);
    const BoundingBox box = ComputeBounds(mesh);
    std::size_t found = 0;
    for (int i = 0; i < 300; ++i) {
      const Vector3d a = testing::RandomPoint(box, &random);
      const Vector3d b = a + 0.1 * (testing::RandomPoint(box, &random) - a);
      if (!space.IsFree(a, b)) continue;
      const double radius = i % 2 == 0 ? 0.3 : 1.0, slack = 1e-10;
      const auto separators = space.FindSeparators(a, b, radius, slack);
      const auto expected = SeparatorsByForce(mesh, a, b, radius, slack);
      ASSERT_EQ(separators.size(), expected.size());
      for (std::size_t k = 0; k < separators.size(); ++k) {
        const Separator& one = separators[k];
        ASSERT_NEAR(one.distance, expected[k].distance, 1e-12);
        ASSERT_TRUE(one.normal.isApprox(expected[k].normal, 1e-9));
        for (const Vector3d& q : one.corners) {
          ASSERT_LE(one.normal.dot(q), one.level);
        }
        for (const Vector3d& q : {a, b}) {
          ASSERT_GE(one.normal.dot(q), one.level + one.distance - 1e-11);
        }
      }
      found += separators.size();
    }
    EXPECT_GT(found, 400U);
  }
}

TEST(FreeSpace, SeparatorsScaleBitForBit) {
  std::mt19937_64 random(12);
  const BoundingBox box = {Vector3d::Constant(-1.0), Vector3d::Constant(1.0)};
  for (int i = 0; i < 200; ++i) {
    std::array<Vector3d, 5> q;
    for (Vector3d& x : q) x = testing::RandomPoint(box, &random);
    const Separator one = SeparatorOf({q[0], q[1], q[2]}, q[3], q[4]);
    for (const int exponent : {-1000, -600, 600, 1020}) {
      std::array<Vector3d, 5> scaled = q;
      for (Vector3d& x : scaled) {
        for (double& c : x) c = std::ldexp(c, exponent);
      }
      const Separator other =
          SeparatorOf({scaled[0], scaled[1], scaled[2]}, scaled[3], scaled[4]);
      EXPECT_EQ(other.distance, std::ldexp(one.distance, exponent));
      EXPECT_EQ(other.normal, one.normal);
      EXPECT_EQ(other.level, std::ldexp(one.level, exponent));
    }
  }
}

// Where numbers have lost digits, what is left of them is.
TEST(FreeSpace, SeparatorsAreFiniteWhereNumbersAreSmallest) {
  std::mt19937_64 random(13);
  const BoundingBox box = {Vector3d::Constant(-1.0), Vector3d::Constant(1.0)};
  constexpr int kExponent = -1040;  // coordinates are multiples of 2⁻³⁴ of it
  for (int i = 0; i < 200; ++i) {
    std::array<Vector3d, 5> q;
    for (Vector3d& x : q) {
      x = testing::RandomPoint(box, &random);
      for (double& c : x) c = std::ldexp(std::round(std::ldexp(c, 20)), -20);
    }
    const Separator one = SeparatorOf({q[0], q[1], q[2]}, q[3], q[4]);
    for (Vector3d& x : q) {
      for (double& c : x) c = std::ldexp(c, kExponent);
    }
    const Separator small = SeparatorOf({q[0], q[1], q[2]}, q[3], q[4]);
    EXPECT_NEAR(std::ldexp(small.distance, -kExponent), one.distance, 1e-9);
    EXPECT_NEAR(small.normal.norm(), one.normal.norm(), 1e-12);
    EXPECT_LT((small.normal - one.normal).norm(), 1e-9 / one.distance + 1e-12);
  }
}

TEST(FreeSpace, TakesAllTrianglesThatASegmentMeetsForSeparators) {
  const FreeSpace space({TakeAsContactSpace(testing::Cube(1))});
  // Through two faces, along a diagonal of one of them.
  const auto met =
      space.FindSeparators({0.0, 0.0, -2.0}, {0.0, 0.0, 2.0}, 0, 0);
  ASSERT_EQ(met.size(), 4U);
  for (const Separator& one : met) {
    EXPECT_EQ(one.distance, 0.0);
    EXPECT_EQ(one.normal, Vector3d::Zero());
  }
}

TEST(PathClearance, IsTheSmallestDistanceAlongThePath) {
  const FreeSpace space = AroundCube();
  // Passes the corner (1, 1, 1) of the contact space at distance √2/2 · 0.5.
  const std::vector<Vector3d> path = {{3.0, -0.5, 0.0}, {-0.5, 3.0, 0.0}};
  const double truth = 0.5 / std::sqrt(2.0);
  EXPECT_NEAR(PathClearance(space, path), truth, 1e-14);
  EXPECT_EQ(PathClearance(space, {{0.0, 2.0, 0.0}, {0.0, 1.0, 0.0}}), 0.0);
}

TEST(CheckPath, NamesTheFirstSegmentThatCollides) {
  const FreeSpace space = AroundCube();
  PathCheck check =
      CheckPath(space, {{2.0, 2.0, 0.0}, {2.0, 0.0, 0.0}, {-2.0, 0.0, 0.0}});
  EXPECT_FALSE(check.free);
  EXPECT_EQ(check.segment, 1);
  EXPECT_DOUBLE_EQ(check.motion.fraction, 0.25);
  EXPECT_TRUE(CheckPath(space, {{2.0, 2.0, 0.0}, {2.0, -2.0, 0.0}}).free);
  EXPECT_FALSE(CheckPath(space, {}).free);
  EXPECT_FALSE(CheckPath(space, {{0.0, 0.0, 0.0}}).free);
}

TEST(FreeSpace, HasNothingFreeAtPointsThatAreNotFinite) {
  const FreeSpace space({TakeAsContactSpace(Cube(1.0))});
  const Vector3d q(3.0, 0.0, 0.0);
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const Vector3d bad(3.0, value, 0.0);
    EXPECT_FALSE(space.IsFree(bad));
    EXPECT_FALSE(space.IsFree(q, bad));
    EXPECT_FALSE(space.IsFree(bad, q));
    EXPECT_EQ(space.Check(q, bad).fraction, 0.0);
    EXPECT_EQ(space.Clearance(bad), 0.0);
    EXPECT_EQ(space.Clearance(q, bad), 0.0);
    EXPECT_TRUE(space.FindSeparators(q, bad, 1.0, 0.0).empty());
    EXPECT_EQ(CheckPath(space, {q, bad, q}).segment, 0);
    EXPECT_EQ(PathClearance(space, {q, bad, q}), 0.0);
  }
  for (const double bad_length : {std::nan(""), -1.0}) {
    EXPECT_TRUE(space.FindSeparators(q, q, bad_length, 0.0).empty());
    EXPECT_TRUE(space.FindSeparators(q, q, 1.0, bad_length).empty());
  }
  EXPECT_EQ(space.FindSeparators(q, q, 1e3, 0.0).size(), 1u);
}

TEST(FreeSpace, RefusesBoundsThatAreNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    const BoundingBox bounds = {Vector3d::Constant(-4.0),
                                Vector3d(4.0, bad, 4.0)};
    EXPECT_THROW(FreeSpace({TakeAsContactSpace(Cube(1.0))}, bounds), InputError)
        << bad;
  }
}

TEST(FreeSpace, RefusesOpenContactMeshes) {
  TriangleMesh mesh = Cube(1.0);
  mesh.triangles.pop_back();
  EXPECT_THROW(FreeSpace({TakeAsContactSpace(mesh)}), InputError);
}

}  // namespace
}  // namespace phongpd
