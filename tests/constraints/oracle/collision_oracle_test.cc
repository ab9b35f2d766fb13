// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes, for which every answer is a comparison of intervals.
#include "constraints/oracle/collision_oracle.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <random>

#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"
#include "tests/support/oracle_of.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;
using testing::OracleOf;

Vector3d RandomPoint(std::mt19937_64* random, double half_width) {
  std::uniform_real_distribution<double> uniform(-half_width, half_width);
  const double x = uniform(*random);
  const double y = uniform(*random);
  return {x, y, uniform(*random)};
}

TEST(CollisionOracle, DecidesCubesByTheirIntervals) {
  const auto oracle = OracleOf<CollisionOracle>(Cube(1.0), Cube(3.0));
  std::mt19937_64 random(1);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d q = RandomPoint(&random, 3.0);
    const double reach = q.cwiseAbs().maxCoeff();
    if (std::abs(reach - 2.0) < 1e-9) continue;
    EXPECT_EQ(oracle.Collides(q), reach < 2.0) << q.transpose();
    hits += reach < 2.0 ? 1 : 0;
  }
  EXPECT_GT(hits, 4000);
  EXPECT_LT(hits, 8000);
}

TEST(CollisionOracle, SeesARobotInsideAndARobotAround) {
  const auto inside = OracleOf<CollisionOracle>(Cube(0.1), Cube(2.0));
  EXPECT_TRUE(inside.Collides({0.3, -0.2, 0.5}));
  EXPECT_FALSE(inside.Collides({1.2, 0.0, 0.0}));
  const auto around = OracleOf<CollisionOracle>(Cube(2.0), Cube(0.1));
  EXPECT_TRUE(around.Collides({0.3, -0.2, 0.5}));
  EXPECT_FALSE(around.Collides({1.2, 0.0, 0.0}));
}

TEST(CollisionOracle, TouchingIsDecidedOnBothSidesOfContact) {
  const auto oracle = OracleOf<CollisionOracle>(Cube(1.0), Cube(1.0));
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d q(0.1, 0.2, 0.3);
    q[axis] = 1.0 - 1e-12;
    EXPECT_TRUE(oracle.Collides(q));
    q[axis] = 1.0 + 1e-12;
    EXPECT_FALSE(oracle.Collides(q));
  }
}

TEST(CollisionOracle, TheCavityOfAVesselIsFree) {
  const TriangleMesh vessel = MakeVessel(4.0, 2.0, 0.0);
  const auto oracle = OracleOf<CollisionOracle>(Cube(0.5), vessel);
  std::mt19937_64 random(2);
  int in_cavity = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector3d q = RandomPoint(&random, 2.6);
    const double reach = q.cwiseAbs().maxCoeff();
    // Free in the cavity (2 wide) and outside (4 wide), robot half-width 1/4.
    const bool expected = reach > 0.75 && reach < 2.25;
    EXPECT_EQ(oracle.Collides(q), expected) << q.transpose();
    in_cavity += reach < 0.75 ? 1 : 0;
  }
  EXPECT_GT(in_cavity, 50);
  // The same with the roles exchanged: the robot is the vessel.
  const auto mirrored = OracleOf<CollisionOracle>(vessel, Cube(0.5));
  EXPECT_FALSE(mirrored.Collides({0.1, 0.2, -0.3}));
  EXPECT_TRUE(mirrored.Collides({0.1, 0.2, -0.9}));
}

TEST(CollisionOracle, OverlappingComponentsAreAUnion) {
  // Parity of both surfaces together would call the overlap |x| < 1 free.
  const TriangleMesh obstacle =
      Joined(MakeBox({-3.0, -1.0, -1.0}, {1.0, 1.0, 1.0}),
             MakeBox({-1.0, -1.5, -1.5}, {3.0, 1.5, 1.5}));
  const auto oracle = OracleOf<CollisionOracle>(Cube(0.1), obstacle);
  EXPECT_TRUE(oracle.Collides({0.0, 0.2, 0.1}));
  EXPECT_TRUE(oracle.Collides({-2.0, 0.2, 0.1}));
  EXPECT_TRUE(oracle.Collides({2.0, 0.2, 0.1}));
  EXPECT_FALSE(oracle.Collides({-2.0, 1.2, 0.1}));
  EXPECT_TRUE(oracle.Collides({2.0, 1.2, 0.1}));
}

TEST(CollisionOracle, ABodyInsideACavityIsSolid) {
  const TriangleMesh obstacle = Joined(MakeVessel(6.0, 4.0, 0.0), Cube(1.0));
  const auto oracle = OracleOf<CollisionOracle>(Cube(0.1), obstacle);
  EXPECT_TRUE(oracle.Collides({0.1, 0.1, 0.1}));
  EXPECT_FALSE(oracle.Collides({1.0, 1.0, 1.0}));
  EXPECT_TRUE(oracle.Collides({2.5, 0.0, 0.0}));
  EXPECT_FALSE(oracle.Collides({3.5, 0.0, 0.0}));
}

TEST(CollisionOracle, EveryComponentOfBothSidesIsTried) {
  // Only the second component of each can meet the other.
  const TriangleMesh robot = Joined(Cube(0.2, {100.0, 0.0, 0.0}), Cube(0.2));
  const TriangleMesh obstacle = Joined(Cube(0.2, {0.0, 100.0, 0.0}), Cube(2.0));
  EXPECT_TRUE(
      OracleOf<CollisionOracle>(robot, obstacle).Collides({0.1, 0.1, 0.1}));
  EXPECT_TRUE(
      OracleOf<CollisionOracle>(obstacle, robot).Collides({0.1, 0.1, 0.1}));
  EXPECT_FALSE(
      OracleOf<CollisionOracle>(robot, obstacle).Collides({5.0, 0.0, 0.0}));
}

TEST(CollisionOracle, SwappingRolesMirrorsTheConfiguration) {
  const TriangleMesh cone = MakeCone(0.8, 1.6, 12);
  const TriangleMesh axes = MakeAxes(2.0, 0.2);
  const auto oracle = OracleOf<CollisionOracle>(cone, axes);
  const auto swapped = OracleOf<CollisionOracle>(axes, cone);
  std::mt19937_64 random(3);
  for (int i = 0; i < 3000; ++i) {
    const Vector3d q = RandomPoint(&random, 3.0);
    EXPECT_EQ(oracle.Collides(q), swapped.Collides(-q)) << q.transpose();
  }
}

TEST(CollisionOracle, RefusesWhatItCannotJudge) {
  const Solid cube = MakeSolid(Cube(1.0), "cube");
  EXPECT_THROW(CollisionOracle(Solid(), cube), InputError);
  EXPECT_THROW(CollisionOracle(cube, Solid()), InputError);
  const auto oracle = OracleOf<CollisionOracle>(Cube(1.0), Cube(1.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(oracle.Collides({nan, 0.0, 0.0}), InputError);
  EXPECT_THROW(oracle.Collides({0.0, inf, 0.0}), InputError);
}

}  // namespace
}  // namespace phongpd
