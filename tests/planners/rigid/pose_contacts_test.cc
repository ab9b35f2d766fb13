// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: every pair of triangles, by each edge of one against the other.
#include "planners/rigid/pose_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "core/bvh/segment_triangle_distance.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/rigid_truth.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::ContactSurface;
using internal::FindContacts;
using internal::PoseContact;
using testing::PlacedMesh;
using testing::PoseAt;

double DistanceOf(const TriangleCorners& a, const TriangleCorners& b) {
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    squared = std::min(
        {squared, ClosestPair(a[i], a[j], b[0], b[1], b[2]).squared_distance,
         ClosestPair(b[i], b[j], a[0], a[1], a[2]).squared_distance});
  }
  return std::sqrt(squared);
}

double DistanceOf(const Vector3d& x, const std::vector<TriangleCorners>& all) {
  double least = std::numeric_limits<double>::infinity();
  for (const TriangleCorners& t : all) {
    least = std::min(least, DistanceOf({x, x, x}, t));
  }
  return least;
}

struct Placed {
  ContactSurface robot, obstacle;
  RobotPose pose;
  std::vector<TriangleCorners> robot_corners, obstacle_corners;
};

// Balls of flat faces, near each other; some of their triangles meet.
Placed Draw(std::mt19937_64* random) {
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const TriangleMesh robot = MakeIcoBall(1.0, 1),
                     obstacle = MakeIcoBall(1.3, 1);
  const Vector3d away(place(*random), place(*random), place(*random));
  const RobotPose pose =
      PoseAt(away.normalized() * (2.1 + 0.3 * place(*random)),
             Eigen::Quaterniond(RandomRotation(random)));
  return {ContactSurface({robot}), ContactSurface({obstacle}), pose,
          CornersOf(PlacedMesh(robot, RigidMotion(pose, pose), 0.0)),
          CornersOf(obstacle)};
}

std::vector<double> GapsOf(const std::vector<PoseContact>& contacts) {
  std::vector<double> gaps;
  for (const PoseContact& contact : contacts) gaps.push_back(contact.gap);
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

TEST(PoseContacts, AreAllPairsWithinTheRadiusThatDoNotMeet) {
  constexpr double kRadius = 0.25;
  std::mt19937_64 random(3);
  std::size_t found = 0, meeting = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Placed placed = Draw(&random);
    std::vector<double> expected;
    for (const TriangleCorners& mine : placed.robot_corners) {
      for (const TriangleCorners& its : placed.obstacle_corners) {
        const double distance = DistanceOf(mine, its);
        if (distance > 1e-12 && distance <= kRadius) {
          expected.push_back(distance);
        }
        meeting += distance == 0.0 ? 1 : 0;
      }
    }
    std::sort(expected.begin(), expected.end());
    std::vector<PoseContact> contacts;
    long tests = 0;
    FindContacts(placed.robot, placed.obstacle, placed.pose, kRadius, &contacts,
                 &tests);
    const std::vector<double> gaps = GapsOf(contacts);
    ASSERT_EQ(gaps.size(), expected.size());
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      EXPECT_NEAR(gaps[i], expected[i], 1e-12);
    }
    found += gaps.size();
    for (const PoseContact& contact : contacts) {
      // On the robot, and along the normal on the obstacle.
      const Vector3d x = placed.pose.position + contact.arm;
      EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-12);
      EXPECT_NEAR(DistanceOf(x, placed.robot_corners), 0.0, 1e-12);
      EXPECT_NEAR(
          DistanceOf(x - contact.gap * contact.normal, placed.obstacle_corners),
          0.0, 1e-9);
    }
  }
  EXPECT_GT(found, 1000u);
  EXPECT_GT(meeting, 100u);
}

TEST(PoseContacts, AreTheNearestWhereMoreAreWithinTheRadius) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Placed placed = Draw(&random);
    std::vector<PoseContact> all, nearest;
    long tests = 0, fewer = 0;
    FindContacts(placed.robot, placed.obstacle, placed.pose, 0.8, &all, &tests);
    std::vector<double> expected = GapsOf(all);
    ASSERT_GT(expected.size(), 200u);
    for (const std::size_t most : {std::size_t{1}, std::size_t{20},
                                   expected.size(), expected.size() + 1}) {
      FindContacts(placed.robot, placed.obstacle, placed.pose, 0.8, &nearest,
                   &fewer, most);
      const std::vector<double> first(
          expected.begin(),
          expected.begin() +
              static_cast<std::ptrdiff_t>(std::min(most, expected.size())));
      EXPECT_EQ(GapsOf(nearest), first);
    }
    EXPECT_LT(fewer, 4 * tests);
  }
}

}  // namespace
}  // namespace phongpd
