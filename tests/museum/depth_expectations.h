// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "core/contact/contact_space.h"
#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"
#include "core/projection/euclidean_metric.h"

// What a pair at q must be, asked for twice: from windows and of the whole
// contact space.
namespace phongpd::testing {

inline DepthResult ExpectDepth(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const Eigen::Vector3d& q, double depth) {
  const DepthResult found = PenetrationDepth(robot, obstacle, {q});
  EXPECT_EQ(found.status, DepthStatus::kPenetrating);
  EXPECT_TRUE(found.certified);
  EXPECT_NEAR(found.depth, depth, 1e-9);
  EXPECT_NEAR((found.contact - q).norm(), depth, 1e-9);
  const EuclideanMetric whole(BuildContactSpace(robot, obstacle));
  EXPECT_TRUE(whole.Query(q).inside);
  EXPECT_NEAR(whole.Query(q).signed_distance, -depth, 1e-9);
  // That far they still touch, a little farther they do not.
  const Eigen::Vector3d out = q + (depth + 1e-6) * found.direction;
  EXPECT_EQ(PenetrationDepth(robot, obstacle, {out}).status,
            DepthStatus::kSeparate);
  return found;
}

inline DepthResult ExpectTouching(const TriangleMesh& robot,
                                  const TriangleMesh& obstacle,
                                  const Eigen::Vector3d& q) {
  const DepthResult found = PenetrationDepth(robot, obstacle, {q});
  EXPECT_EQ(found.status, DepthStatus::kTouching);
  EXPECT_TRUE(found.certified);
  EXPECT_EQ(found.depth, 0.0);
  EXPECT_EQ(found.clearance, 0.0);
  EXPECT_NEAR(found.direction.norm(), 1.0, 1e-12);
  const EuclideanMetric whole(BuildContactSpace(robot, obstacle));
  EXPECT_FALSE(whole.Query(q).inside);
  EXPECT_EQ(whole.Query(q).signed_distance, 0.0);
  return found;
}

inline void ExpectSeparate(const TriangleMesh& robot,
                           const TriangleMesh& obstacle,
                           const Eigen::Vector3d& q, double clearance) {
  const DepthResult found = PenetrationDepth(robot, obstacle, {q});
  EXPECT_EQ(found.status, DepthStatus::kSeparate);
  EXPECT_NEAR(found.clearance, clearance, 1e-12);
  const EuclideanMetric whole(BuildContactSpace(robot, obstacle));
  EXPECT_NEAR(whole.Query(q).signed_distance, clearance, 1e-12);
}

}  // namespace phongpd::testing
