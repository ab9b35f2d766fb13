// SPDX-License-Identifier: GPL-3.0-or-later
// The self-check of contact spaces on needles and plates, thinner than the step
// by which it leaves the surface.  Truth: the sum of two boxes with common
// directions of their edges is a box.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/solid/solid.h"
#include "planners/exact/verification.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Integer columns at right angles, all of one length.
std::vector<Matrix3d> Frames() {
  std::vector<Matrix3d> frames(4);
  frames[0] = Matrix3d::Identity();
  frames[1] << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  frames[2] << 1, 2, 2, 2, 1, -2, 2, -2, 1;
  frames[3] << 2, 3, 6, 3, -6, 2, 6, 2, -3;  // length 7, a reflection
  return frames;
}

TriangleMesh TurnedBox(const Matrix3d& frame, const Vector3d& size) {
  TriangleMesh mesh = MakeBox(-size, size);
  for (Vector3d& v : mesh.vertices) v = frame * v;
  if (frame.determinant() < 0.0) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

// Half the edges of needles and plates.
std::vector<Vector3d> ThinSizes() {
  std::vector<Vector3d> sizes;
  for (const double aspect : {1e3, 1e5, 1e7, 1e9}) {
    sizes.push_back({1.0, 1.0, aspect});
    sizes.push_back({aspect, aspect, 1.0});
  }
  return sizes;
}

struct ThinPair {
  ThinPair(const Matrix3d& turn, const Vector3d& size)
      : frame(turn),
        half(size + Vector3d::Ones()),
        robot(TurnedBox(turn, Vector3d::Ones())),
        obstacle(TurnedBox(turn, size)) {}

  Verifier MakeVerifier() const {
    Workspace solids;
    solids.robot = MakeSolid(robot, "robot");
    solids.obstacles = {MakeSolid(obstacle, "obstacle")};
    return Verifier(solids);
  }
  double Unit() const { return frame.col(0).norm(); }
  // δ of the contracts.
  double Tolerance(const Verifier& verifier) const {
    return 1e-9 * ComputeBounds(TurnedBox(frame, half)).Diagonal() +
           2.0 * verifier.rounding();
  }
  // To the surface of C_obj; negative inside.
  double Distance(const Vector3d& q) const {
    const double unit = Unit();
    const Vector3d beyond =
        (frame.transpose() * q / unit).cwiseAbs() - unit * half;
    const double outside = beyond.cwiseMax(0.0).norm();
    return outside > 0.0 ? outside : beyond.maxCoeff();
  }

  Matrix3d frame;
  Vector3d half;
  TriangleMesh robot, obstacle;
};

TEST(ThinSolids, TheirContactSpacesAreConfirmed) {
  for (const Matrix3d& frame : Frames()) {
    for (const Vector3d& size : ThinSizes()) {
      const ThinPair pair(frame, size);
      const Verifier verifier = pair.MakeVerifier();
      const TriangleMesh mesh =
          BuildContactSpace(pair.robot, pair.obstacle).mesh();
      ASSERT_EQ(mesh.triangles.size(), 12U);
      for (const Triangle& t : mesh.triangles) {
        const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                       &c = mesh.vertices[t[2]];
        const Vector3d n = (b - a).cross(c - a).stableNormalized();
        const Vector3d x = (a + b + c) / 3.0;
        const Verification right = verifier.VerifySurface(x, n);
        EXPECT_EQ(right.verdict, Verdict::kConfirmed)
            << right.reason << ", half edges " << size.transpose();
        // The same facet where no surface is.
        const double delta = pair.Tolerance(verifier);
        for (const double factor : {3.0, 30.0, -3.0, -30.0}) {
          const Vector3d moved = x + factor * delta * n;
          if (std::abs(pair.Distance(moved)) <= 2.0 * delta) continue;
          EXPECT_EQ(verifier.VerifySurface(moved, n).verdict, Verdict::kRefuted)
              << factor << ", half edges " << size.transpose();
        }
      }
    }
  }
}

// A needle of three directions: integer corners, nothing parallel.
TEST(ThinSolids, NeedlesOfTetrahedraAreConfirmed) {
  const auto tetrahedron = [](const Vector3d& apex) {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, apex};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
  };
  for (const double length : {1e3, 1e6, 1e9}) {
    for (const Vector3d& direction : {Vector3d(0, 0, 1), Vector3d(0.6, 0, 0.8),
                                      Vector3d(0.48, 0.6, 0.64)}) {
      const TriangleMesh robot = tetrahedron({0, 0, 1});
      const TriangleMesh obstacle =
          tetrahedron((length * direction).array().round());
      Workspace solids;
      solids.robot = MakeSolid(robot, "robot");
      solids.obstacles = {MakeSolid(obstacle, "needle")};
      const Verifier verifier(solids);
      const TriangleMesh mesh = BuildContactSpace(robot, obstacle).mesh();
      for (const Triangle& t : mesh.triangles) {
        const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                       &c = mesh.vertices[t[2]];
        const Verification right = verifier.VerifySurface(
            (a + b + c) / 3.0, (b - a).cross(c - a).stableNormalized());
        EXPECT_EQ(right.verdict, Verdict::kConfirmed)
            << right.reason << ", length " << length;
      }
    }
  }
}

// What is not refuted is near a surface, whatever normal is claimed.
TEST(ThinSolids, WhatIsFartherThanTheToleranceIsRefuted) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto vector = [&] {
    return Vector3d(any(random), any(random), any(random));
  };
  long refuted = 0, others = 0;
  for (const Matrix3d& frame : Frames()) {
    for (const Vector3d& size : ThinSizes()) {
      const ThinPair pair(frame, size);
      const Verifier verifier = pair.MakeVerifier();
      const double delta = pair.Tolerance(verifier);
      for (int i = 0; i < 300; ++i) {
        // Beside the sum, or in it, mostly by a few δ.
        const Vector3d in_box = pair.half.cwiseProduct(vector());
        const Vector3d x =
            frame * in_box + (i % 3 == 0 ? 1.0 : 8.0) * delta * vector();
        const Verdict found =
            verifier.VerifySurface(x, vector().normalized()).verdict;
        const double distance = std::abs(pair.Distance(x));
        if (found == Verdict::kRefuted) {
          ++refuted;
        } else {
          ++others;
          EXPECT_LE(distance, (1.0 + 1e-6) * delta);
        }
      }
    }
  }
  EXPECT_GT(refuted, 1000);
  EXPECT_GT(others, 100);
}

}  // namespace
}  // namespace phongpd
