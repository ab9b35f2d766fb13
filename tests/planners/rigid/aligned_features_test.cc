// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the edges and faces of a cube, known by its symmetry.
#include "planners/rigid/aligned_features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using internal::AlignedFeatures;
using testing::Cube;

// Each face once more, seen from its other side.
TriangleMesh StoredTwice(TriangleMesh mesh) {
  const std::size_t once = mesh.triangles.size();
  for (std::size_t i = 0; i < once; ++i) {
    const Triangle t = mesh.triangles[i];
    mesh.triangles.push_back({t[2], t[1], t[0]});
  }
  return mesh;
}

// Every second face seen from its other side only.
TriangleMesh TurnedHere(TriangleMesh mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) {
    Triangle& t = mesh.triangles[i];
    std::swap(t[0], t[2]);
  }
  return mesh;
}

// With a cube's edges along the axes, and faces across them, aligned cubes are
// turned by one of the cube's own rotations; an edge across a face, as the
// diagonals of faces would be, is at 45°.
void ExpectAligned(const TriangleMesh& robot, const TriangleMesh& obstacle) {
  const AlignedFeatures features({robot}, {obstacle});
  ASSERT_FALSE(features.IsEmpty());
  std::mt19937_64 random(5);
  for (int i = 0; i < 500; ++i) {
    Vector3d along;
    const Matrix3d rotation =
        features.Draw(&random, &along).orientation.toRotationMatrix();
    EXPECT_NEAR(along.cwiseAbs().maxCoeff(), 1.0, 1e-12);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(rotation.col(k).cwiseAbs().maxCoeff(), 1.0, 1e-12);
    }
  }
}

TEST(AlignedFeatures, TurnACubeAlongACube) {
  ExpectAligned(Cube(1.0), Cube(2.0));
}

TEST(AlignedFeatures, LeaveOutDiagonalsOfFacesStoredTwice) {
  ExpectAligned(StoredTwice(Cube(1.0)), StoredTwice(Cube(2.0)));
}

TEST(AlignedFeatures, LeaveOutDiagonalsWhicheverSideFacesShow) {
  ExpectAligned(TurnedHere(Cube(1.0)), TurnedHere(Cube(2.0)));
}

}  // namespace
}  // namespace phongpd
