// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms, Euclidean PD on the whole contact space, FCL.
#include "core/contact/depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "constraints/collision_oracle.h"
#include "core/bvh/surface_tree.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;

// The place of a witness on the solid it should lie on.
double DistanceToSurface(const TriangleMesh& mesh, const Vector3d& x) {
  return SurfaceTree(mesh).FindClosest(x).distance;
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
  EXPECT_NE(result.robot_feature.kind, ContactFeature::kNone);
  EXPECT_NE(result.obstacle_feature.kind, ContactFeature::kNone);
}

struct Pair {
  const char* name;
  TriangleMesh robot, obstacle;
};

std::vector<Pair> Pairs() {
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
  for (const Pair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const ContactSpace space = BuildContactSpace(pair.robot, pair.obstacle);
    const EuclideanMetric metric(space.mesh);
    const BoundingBox box = ComputeBounds(space.mesh);
    const DepthQuery query(pair.robot, pair.obstacle);
    for (int i = 0; i < 60; ++i) {
      // Half of them near the surface.
      Vector3d q = testing::RandomPoint(box, &random);
      if (i % 2 == 0) {
        const auto on_surface =
            testing::RandomSurfacePoint(space.mesh, &random);
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
  for (const Pair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const DepthQuery query(pair.robot, pair.obstacle);
    for (int turn = 0; turn < 2; ++turn) {
      RobotPose pose;
      pose.orientation = Eigen::Quaterniond(testing::RandomRotation(&random));
      const TriangleMesh turned =
          Rotated(pair.robot, pose.orientation.toRotationMatrix());
      const ContactSpace space = BuildContactSpace(turned, pair.obstacle);
      const EuclideanMetric metric(space.mesh);
      const BoundingBox box = ComputeBounds(space.mesh);
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

}  // namespace
}  // namespace phongpd
