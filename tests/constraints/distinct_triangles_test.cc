// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the same surface stored once, and which triangles are the same by
// comparing every pair.
#include "constraints/rigid/distinct_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "constraints/rigid/rigid_judge.h"
#include "tests/support/rigid_truth.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::DistinctTriangles;
using testing::Cube;
using testing::MeetExactly;
using testing::PlacedMesh;
using testing::PoseAt;
using testing::RandomRotation;

// Each face once more, seen from its other side, and its corners elsewhere in
// the list of vertices, as files of many programs have them.
TriangleMesh StoredTwice(const TriangleMesh& mesh) {
  TriangleMesh twice;
  for (const Triangle& t : mesh.triangles) {
    for (const Triangle& side : {t, Triangle{t[2], t[1], t[0]}}) {
      Triangle own;
      for (std::size_t k = 0; k < 3; ++k) {
        own[k] = static_cast<int>(twice.vertices.size());
        twice.vertices.push_back(
            mesh.vertices[static_cast<std::size_t>(side[k])]);
      }
      twice.triangles.push_back(own);
    }
  }
  return twice;
}

// A cube without one of its triangles: no solid, so that surfaces alone count.
TriangleMesh OpenCube(double size) {
  TriangleMesh cube = Cube(size);
  cube.triangles.pop_back();
  return cube;
}

bool IsSame(TriangleCorners a, const TriangleCorners& b) {
  return std::is_permutation(a.begin(), a.end(), b.begin());
}

TEST(DistinctTriangles, AreThoseThatAreNoneBefore) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> coordinate(0, 1);
  std::size_t repeated = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<TriangleCorners> corners(30);
    for (TriangleCorners& triangle : corners) {
      for (Vector3d& x : triangle) {
        for (int k = 0; k < 3; ++k) x[k] = 0.1 * coordinate(random);
      }
    }
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const bool is_new = std::none_of(
          expected.begin(), expected.end(),
          [&](std::size_t k) { return IsSame(corners[k], corners[i]); });
      if (is_new) expected.push_back(i);
    }
    repeated += corners.size() - expected.size();
    EXPECT_EQ(DistinctTriangles(corners), expected);
  }
  EXPECT_GT(repeated, 100u);
  EXPECT_TRUE(DistinctTriangles({}).empty());
}

TEST(RigidJudge, JudgesFacesStoredTwiceAsThoughOnce) {
  const TriangleMesh robot = OpenCube(1.0), obstacle = OpenCube(2.0);
  const TriangleMesh robot_twice = StoredTwice(robot);
  const TriangleMesh obstacle_twice = StoredTwice(obstacle);
  const RigidJudge once(robot, obstacle), twice(robot_twice, obstacle_twice);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-2.5, 2.5);
  const auto pose = [&] {
    return PoseAt(Vector3d(place(random), place(random), place(random)),
                  Eigen::Quaterniond(RandomRotation(&random)));
  };
  int free = 0, colliding = 0;
  for (int i = 0; i < 300; ++i) {
    const RigidMotion motion(pose(), pose());
    const RigidCheck expected = once.Check(motion);
    const RigidCheck check = twice.Check(motion);
    EXPECT_EQ(check.outcome, expected.outcome);
    EXPECT_EQ(check.tests, expected.tests);
    (check.IsFree() ? free : colliding) += 1;
    if (check.outcome != MotionVerdict::kCollides) continue;
    // Triangles are named by their numbers in the mesh as it was given.
    EXPECT_TRUE(MeetExactly(PlacedMesh(robot_twice, motion, check.time),
                            check.robot_triangle, obstacle_twice,
                            check.obstacle_triangle));
    EXPECT_EQ(check.robot_triangle / 2, expected.robot_triangle);
    EXPECT_EQ(check.obstacle_triangle / 2, expected.obstacle_triangle);
  }
  EXPECT_GT(free, 30);
  EXPECT_GT(colliding, 30);
}

}  // namespace
}  // namespace phongpd
