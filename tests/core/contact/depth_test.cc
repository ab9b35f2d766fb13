// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms, and Euclidean PD on the whole contact space.
#include "core/contact/depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/named_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;
using testing::NamedPair;

// The place of a witness on the solid it should lie on.
double DistanceToSurface(const TriangleMesh& mesh, const Vector3d& x) {
  return TriangleBvh(mesh).FindClosest(x).distance;
}

// Of x to the vertex, edge or facet.
double DistanceToFeature(const TriangleMesh& mesh,
                         const ContactFeature& feature, const Vector3d& x) {
  TriangleMesh alone;
  const int count = feature.kind;
  for (int k = 0; k < 3; ++k) {
    const int v = feature.vertices[static_cast<std::size_t>(k % count)];
    alone.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
  }
  alone.triangles = {{0, 1, 2}};
  return TriangleBvh(alone).FindClosest(x).distance;
}

void ExpectWitness(const TriangleMesh& placed_robot,
                   const TriangleMesh& obstacle, const Vector3d& q,
                   const DepthResult& result) {
  const double size = std::max(ComputeBounds(placed_robot).Diagonal(),
                               ComputeBounds(obstacle).Diagonal());
  const double tolerance = 1e-11 * (size + q.norm());
  EXPECT_LE(DistanceToSurface(placed_robot, result.on_robot - q), tolerance);
  EXPECT_LE(DistanceToSurface(obstacle, result.on_obstacle), tolerance);
  const Vector3d way = result.on_obstacle - result.on_robot;
  EXPECT_NEAR(way.norm(), result.depth + result.clearance, tolerance);
  EXPECT_LE((result.contact - q - way).norm(), tolerance);
  EXPECT_NEAR(result.direction.norm(), 1.0, 1e-12);
  ASSERT_NE(result.robot_feature.kind, ContactFeature::kNone);
  ASSERT_NE(result.obstacle_feature.kind, ContactFeature::kNone);
  EXPECT_LE(DistanceToFeature(placed_robot, result.robot_feature,
                              result.on_robot - q),
            tolerance);
  EXPECT_LE(
      DistanceToFeature(obstacle, result.obstacle_feature, result.on_obstacle),
      tolerance);
}

std::vector<NamedPair> Pairs() {
  return {
      {"ball and cone", MakeIcoBall(0.5, 2), MakeCone(0.8, 1.6, 24)},
      {"star and torus", MakeStar(0.5, 1.2), MakeTorus(2, 0.6, 16, 8)},
      {"wrench and ball", MakeWrench(0.5, 12, 12, 8, 8), MakeIcoBall(1, 2)},
      {"cube and hollow shell", Cube(1), MakeVessel(4, 3, 0)},
      {"turned star and hollow shell",
       Rotated(MakeStar(0.3, 0.7), GenericRotation()), MakeVessel(4, 3, 0)},
      {"cube and vessel with a window", Cube(0.5), MakeVessel(3.6, 3, 0.6)},
      {"blob and knot", MakeBlob(0.4, 2, 0.35, 1), MakeKnot(0.5, 0.225, 48, 6)},
      {"star and blob", MakeStar(0.3, 0.8), MakeBlob(1.5, 3, 0.35, 2)},
  };
}

TEST(DepthQuery, EqualsEuclideanDepthOnTheWholeContactSpace) {
  std::mt19937_64 random(11);
  int penetrating = 0, by_window = 0;
  for (const NamedPair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const ContactSpace space = BuildContactSpace(pair.robot, pair.obstacle);
    const EuclideanMetric metric(space);
    const BoundingBox box = space.bounds();
    const DepthQuery query(pair.robot, pair.obstacle);
    for (int i = 0; i < 60; ++i) {
      // Half of them near the surface.
      Vector3d q = testing::RandomPoint(box, &random);
      if (i % 2 == 0) {
        const auto on_surface =
            testing::RandomSurfacePoint(space.mesh(), &random);
        q = on_surface.position -
            std::ldexp(box.Diagonal(), -4 - i % 30) * on_surface.normal;
      }
      SCOPED_TRACE(i);
      const DepthResult found = query.At(q);
      const PenetrationResult truth = metric.Query(q);
      EXPECT_TRUE(found.certified);
      EXPECT_EQ(found.status == DepthStatus::kPenetrating, truth.inside);
      EXPECT_NEAR(found.clearance - found.depth, truth.signed_distance,
                  1e-12 * box.Diagonal());
      EXPECT_LE(found.depth, found.explored_radius);
      ExpectWitness(pair.robot, pair.obstacle, q, found);
      penetrating += truth.inside;
      by_window += found.level == DepthLevel::kWindow;
    }
  }
  EXPECT_GT(penetrating, 200);
  EXPECT_GT(by_window, 100);
}

TEST(DepthQuery, EqualsTheWholeContactSpaceAtTurnedPoses) {
  std::mt19937_64 random(12);
  for (const NamedPair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const DepthQuery query(pair.robot, pair.obstacle);
    for (int turn = 0; turn < 2; ++turn) {
      RobotPose pose;
      pose.orientation = Eigen::Quaterniond(testing::RandomRotation(&random));
      const TriangleMesh turned =
          Rotated(pair.robot, pose.orientation.toRotationMatrix());
      const ContactSpace space = BuildContactSpace(turned, pair.obstacle);
      const EuclideanMetric metric(space);
      const BoundingBox box = space.bounds();
      for (int i = 0; i < 4; ++i) {
        pose.position = testing::RandomPoint(box, &random);
        const DepthResult found = query.At(pose);
        EXPECT_TRUE(found.certified);
        EXPECT_NEAR(found.clearance - found.depth,
                    metric.Query(pose.position).signed_distance,
                    1e-12 * box.Diagonal());
        ExpectWitness(turned, pair.obstacle, pose.position, found);
      }
    }
  }
}

TEST(DepthQuery, IsTheLeastOverlapOfTwoBoxes) {
  const TriangleMesh box = MakeBox({-1, -1, -1}, {1, 1, 1});
  const DepthQuery query(box, box);
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> offset(-1.99, 1.99);
  for (int i = 0; i < 200; ++i) {
    const Vector3d q(offset(random), offset(random), offset(random));
    const DepthResult found = query.At(q);
    ASSERT_EQ(found.status, DepthStatus::kPenetrating);
    EXPECT_TRUE(found.certified);
    int axis = 0;
    const double least = 2.0 - q.cwiseAbs().maxCoeff(&axis);
    EXPECT_NEAR(found.depth, least, 1e-14);
    EXPECT_NEAR(found.direction[axis], q[axis] > 0 ? 1.0 : -1.0, 1e-14);
    ExpectWitness(box, box, q, found);
  }
}

TEST(DepthQuery, IsHowFarACubeOnItsDiagonalSinksIn) {
  const TriangleMesh floor = MakeBox({-5, -5, -4}, {5, 5, 0});
  RobotPose pose;
  pose.orientation =
      Eigen::Quaterniond::FromTwoVectors(Vector3d(1, 1, 1), Vector3d(0, 0, 1));
  const DepthQuery query(Cube(1), floor);
  for (const double sunk : {0.3, 0.01, 1e-6}) {
    pose.position = {0.1, 0.2, std::sqrt(0.75) - sunk};
    const DepthResult found = query.At(pose);
    EXPECT_EQ(found.status, DepthStatus::kPenetrating);
    EXPECT_TRUE(found.certified);
    EXPECT_NEAR(found.depth, sunk,
                8 * std::sqrt(3.0) * found.grid_step + 1e-14);
    EXPECT_EQ(found.robot_feature.kind, ContactFeature::kVertex);
    EXPECT_NEAR(found.direction[2], 1.0, 1e-12);
  }
  pose.position = {0.1, 0.2, std::sqrt(0.75) + 0.25};
  const DepthResult apart = query.At(pose);
  EXPECT_EQ(apart.status, DepthStatus::kSeparate);
  EXPECT_NEAR(apart.clearance, 0.25, 1e-10);
}

TEST(DepthQuery, CallsFlushSolidsTouchingExactly) {
  // Decimals, which no double is.
  const TriangleMesh a = MakeBox({0.1, 0.1, 0.1}, {0.4, 0.4, 0.4});
  const TriangleMesh b = MakeBox({0.7, 0.1, 0.1}, {1.3, 0.4, 0.4});
  const DepthQuery query(a, b);
  const Vector3d flush[] = {
      {0.3, 0, 0}, {0.3, 0.1, -0.2}, {0.3, 0.3, 0}, {0.3, 0.3, 0.3}};
  for (const Vector3d& q : flush) {
    const DepthResult found = query.At(q);
    EXPECT_EQ(found.status, DepthStatus::kTouching) << q.transpose();
    EXPECT_TRUE(found.certified);
    EXPECT_EQ(found.depth, 0.0);
    EXPECT_EQ(found.clearance, 0.0);
    EXPECT_NEAR(found.direction.norm(), 1.0, 1e-15);
    ExpectWitness(a, b, q, found);
  }
  const double hair = 0x1p-40;
  EXPECT_EQ(query.At(Vector3d(0.3 + hair, 0, 0)).status,
            DepthStatus::kPenetrating);
  EXPECT_NEAR(query.At(Vector3d(0.3 + hair, 0, 0)).depth, hair, 1e-15);
  EXPECT_EQ(query.At(Vector3d(0.3 - hair, 0, 0)).status,
            DepthStatus::kSeparate);
  EXPECT_NEAR(query.At(Vector3d(0.3 - hair, 0, 0)).clearance, hair, 1e-15);
}

TEST(DepthQuery, LeavesAnExactHoleAlongItsAxis) {
  const TriangleMesh plate = MakePlateWithHole(4, 1, 1);
  const TriangleMesh peg = MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1});
  const DepthQuery exact(peg, plate);
  // Free only above or below the plate.
  const DepthResult fits = exact.At(Vector3d(0, 0, 0.25));
  EXPECT_EQ(fits.status, DepthStatus::kPenetrating);
  EXPECT_NEAR(fits.depth, 1.25, 1e-13);
  EXPECT_NEAR(fits.direction[2], 1.0, 1e-13);
  EXPECT_EQ(exact.At(Vector3d(0, 0, 1.5)).status, DepthStatus::kTouching);
  const TriangleMesh loose = MakeBox({-0.495, -0.495, -1}, {0.495, 0.495, 1});
  const DepthResult free = DepthQuery(loose, plate).At(Vector3d::Zero());
  EXPECT_EQ(free.status, DepthStatus::kSeparate);
  EXPECT_NEAR(free.clearance, 0.005, 1e-15);
}

TEST(DepthQuery, AnswersNestedSolidsAndCavities) {
  const DepthResult nested = PenetrationDepth(Cube(1), Cube(4));
  EXPECT_EQ(nested.status, DepthStatus::kPenetrating);
  EXPECT_NEAR(nested.depth, 2.5, 1e-14);
  EXPECT_NEAR(PenetrationDepth(Cube(4), Cube(1)).depth, 2.5, 1e-14);
  const DepthQuery shell(Cube(1), MakeVessel(4, 3, 0));
  const DepthResult inside = shell.At(Vector3d(0.25, 0, 0));
  EXPECT_EQ(inside.status, DepthStatus::kSeparate);
  EXPECT_NEAR(inside.clearance, 0.75, 1e-14);
  EXPECT_EQ(shell.At(Vector3d(1, 0, 0)).status, DepthStatus::kTouching);
  // Back into the cavity is nearer than out.
  const DepthResult wall = shell.At(Vector3d(1.25, 0, 0));
  EXPECT_NEAR(wall.depth, 0.25, 1e-14);
  EXPECT_NEAR(wall.direction[0], -1.0, 1e-14);
}

TEST(DepthQuery, AnswersFarApartSolids) {
  const DepthQuery query(Cube(2), Cube(2));
  for (const double far : {1e3, 1e9, 1e14}) {
    const DepthResult found = query.At(Vector3d(0, 0, far));
    EXPECT_EQ(found.status, DepthStatus::kSeparate);
    EXPECT_NEAR(found.clearance, far - 2.0, 1e-15 * far);
    EXPECT_NEAR(found.direction[2], 1.0, 1e-15);
  }
  EXPECT_THROW(query.At(Vector3d(0, 0, 1e18)), InputError);
}

TEST(DepthQuery, SaysWhatALimitLeftOpen) {
  const TriangleMesh star = MakeStar(0.5, 1.2),
                     torus = MakeTorus(2, 0.6, 16, 8);
  const Vector3d q(2, 0, 0);
  const DepthResult truth = PenetrationDepth(star, torus, {q, {1, 0, 0, 0}});
  ASSERT_TRUE(truth.certified);
  DepthOptions options;
  options.max_radius = 0.5 * truth.depth;
  const DepthResult bound =
      PenetrationDepth(star, torus, {q, {1, 0, 0, 0}}, options);
  EXPECT_EQ(bound.status, DepthStatus::kPenetrating);
  EXPECT_FALSE(bound.certified);
  EXPECT_GE(bound.explored_radius, options.max_radius);
  EXPECT_LE(bound.explored_radius, truth.depth);
  EXPECT_GE(bound.depth, truth.depth);
  options.max_radius = 0.0;
  EXPECT_THROW(DepthQuery(star, torus, options), InputError);
}

// No window is started after the limit: the first is all the work there is, and
// what it tells holds.
TEST(DepthQuery, KeepsToItsTimeLimit) {
  const TriangleMesh star = MakeStar(0.5, 1.2),
                     torus = MakeTorus(2, 0.6, 32, 16);
  const RobotPose pose{Vector3d(2, 0, 0), {1, 0, 0, 0}};
  const DepthResult truth = PenetrationDepth(star, torus, pose);
  ASSERT_TRUE(truth.certified);
  ASSERT_GE(truth.windows, 3);
  DepthOptions options;
  options.max_seconds = 1e-9;
  const DepthResult late = PenetrationDepth(star, torus, pose, options);
  EXPECT_EQ(late.status, DepthStatus::kPenetrating);
  EXPECT_FALSE(late.certified);
  EXPECT_LE(late.windows, 1);
  EXPECT_LT(2 * late.arranged_faces, truth.arranged_faces);
  EXPECT_LE(late.explored_radius, truth.depth);
  EXPECT_GE(late.depth, truth.depth);
}

// A certified answer lies in its last window, and nothing was left out of that.
TEST(DepthQuery, TellsItsWindows) {
  const TriangleMesh star = MakeStar(0.5, 1.2),
                     torus = MakeTorus(2, 0.6, 32, 16);
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(0.4, Vector3d(1, 2, 3).normalized()));
  for (const RobotPose& pose : {RobotPose{Vector3d(2, 0, 0), {1, 0, 0, 0}},
                                RobotPose{Vector3d(0, 2, 0.1), turn}}) {
    const DepthResult found = PenetrationDepth(star, torus, pose);
    ASSERT_TRUE(found.certified);
    ASSERT_EQ(found.window_reaches.size(),
              static_cast<std::size_t>(found.windows));
    EXPECT_GE(found.window_reaches.back(), found.depth * (1.0 - 1e-12));
    // Walls are rounded outwards by a step of the grid or two.
    EXPECT_NEAR(found.window_reaches.back(), found.explored_radius,
                1e-6 * found.window_reaches.back());
    EXPECT_TRUE(found.window_axes.isUnitary(1e-14));
    const Vector3d way =
        found.window_axes.transpose() * (found.contact - pose.position);
    EXPECT_LE(way.lpNorm<Eigen::Infinity>(),
              found.window_reaches.back() * (1.0 + 1e-6));
  }
  EXPECT_TRUE(PenetrationDepth(star, torus, {Vector3d(9, 0, 0), {1, 0, 0, 0}})
                  .window_reaches.empty());
}

TEST(DepthQuery, RefusesPosesThatAreNone) {
  const DepthQuery query(Cube(1), Cube(1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(query.At(Vector3d(nan, 0, 0)), InputError);
  RobotPose pose;
  pose.orientation.coeffs() << 0, 0, 0, 1 + 2e-9;
  EXPECT_THROW(query.At(pose), InputError);
  pose.orientation.coeffs() << 0, 0, 0, 1 + 0.5e-9;
  EXPECT_EQ(query.At(pose).status, DepthStatus::kPenetrating);
  pose.orientation.coeffs() << nan, 0, 0, 1;
  EXPECT_THROW(query.At(pose), InputError);
}

}  // namespace
}  // namespace phongpd
