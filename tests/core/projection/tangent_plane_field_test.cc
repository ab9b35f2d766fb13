// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/tangent_plane_field.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "problems/shapes/shapes.h"
#include "tests/support/tangent_plane_cases.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::At;
using testing::Linear;
using testing::OnEdge;
using testing::OneTriangle;
using testing::TangentPlaneCase;
using testing::TangentPlaneCases;

TEST(TangentPlaneField, BasesAreOrthonormalAndRightHanded) {
  for (const TangentPlaneCase& s : TangentPlaneCases()) {
    for (std::size_t v = 0; v < s.planes.bases.size(); ++v) {
      const auto& basis = s.planes.bases[v];
      EXPECT_TRUE((basis * basis.transpose()).isIdentity(1e-14));
      const Vector3d cross = basis.row(0).cross(basis.row(1)).transpose();
      EXPECT_LT((cross - s.field.normals[v]).norm(), 1e-14);
    }
  }
}

TEST(TangentPlaneField, PlaneAtAVertexIsThatOfTheVertex) {
  for (const TangentPlaneCase& s : TangentPlaneCases()) {
    for (int t = 0; t < static_cast<int>(s.planes.frames.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        const Vector3d& n =
            s.field.normals[At(s.field.mesh.triangles[At(t)][At(k)])];
        const Vector3d at =
            TangentPlaneNormal(s.field, s.planes, t, Vector3d::Unit(k));
        EXPECT_LT((at - n).norm(), 1e-13);
        // Along any approach the plane converges to it, at first order.
        for (const double w : {0.0, 0.3, 1.0}) {
          Vector3d away = Vector3d::Zero();
          away[(k + 1) % 3] = w;
          away[(k + 2) % 3] = 1.0 - w;
          const Vector3d near = TangentPlaneNormal(
              s.field, s.planes, t,
              Vector3d((1.0 - 1e-8) * Vector3d::Unit(k) + 1e-8 * away));
          EXPECT_LT((near - n).norm(), 1e-7);
        }
      }
    }
  }
}

TEST(TangentPlaneField, IsContinuousAcrossEdgesAndLinearOnThem) {
  int edges = 0;
  for (const TangentPlaneCase& s : TangentPlaneCases()) {
    for (int t = 0; t < static_cast<int>(s.planes.frames.size()); ++t) {
      const Triangle& tri = s.field.mesh.triangles[At(t)];
      for (int k = 0; k < 3; ++k) {
        const int other = s.field.neighbors[At(t)][At(k)];
        const Triangle& across = s.field.mesh.triangles[At(other)];
        int side = 0;
        while (across[At(side)] != tri[At((k + 1) % 3)]) ++side;
        for (const double u : {1e-9, 0.1, 0.5, 0.8}) {
          const Vector3d here =
              TangentPlaneNormal(s.field, s.planes, t, OnEdge(k, u));
          const Vector3d there = TangentPlaneNormal(s.field, s.planes, other,
                                                    OnEdge(side, 1.0 - u));
          EXPECT_LT((here - there).norm(), 1e-12);
          EXPECT_LT((here - Linear(s.field, t, OnEdge(k, u))).norm(), 1e-12);
          ++edges;
        }
      }
    }
  }
  EXPECT_GT(edges, 1000);
}

TEST(TangentPlaneField, IsContinuousInsideATriangle) {
  for (const TangentPlaneCase& s : TangentPlaneCases()) {
    for (int t = 0; t < static_cast<int>(s.planes.frames.size()); t += 7) {
      Vector3d previous = Vector3d::Zero();
      for (int k = 0; k <= 400; ++k) {
        const double u = k / 400.0;
        const Vector3d lambda(1.0 - u, 0.7 * u, 0.3 * u);
        const Vector3d n = TangentPlaneNormal(s.field, s.planes, t, lambda);
        EXPECT_NEAR(n.norm(), 1.0, 1e-14);
        if (k > 0) {
          EXPECT_LT((n - previous).norm(), 0.05);
        }
        previous = n;
      }
    }
  }
}

TEST(TangentPlaneField, DiffersFromTheNormalFieldAtHigherOrderInside) {
  // Quotients of the difference when all normal angles are halved.
  const Vector3d z = Vector3d::UnitZ();
  const std::array<Vector3d, 3> lean = {
      Vector3d(1.0, 0.2, 0), Vector3d(-0.3, 0.9, 0), Vector3d(-0.4, -0.8, 0)};
  std::vector<double> difference;
  for (const double angle : {0.4, 0.2, 0.1, 0.05}) {
    const TangentPlaneCase s = OneTriangle({Vector3d(z + angle * lean[0]),
                                            Vector3d(z + angle * lean[1]),
                                            Vector3d(z + angle * lean[2])});
    double worst = 0.0;
    for (const double a : {0.2, 1.0 / 3.0, 0.5}) {
      const Vector3d lambda(a, 0.6 * (1.0 - a), 0.4 * (1.0 - a));
      worst =
          std::max(worst, (TangentPlaneNormal(s.field, s.planes, 0, lambda) -
                           Linear(s.field, 0, lambda))
                              .norm());
    }
    difference.push_back(worst);
  }
  for (std::size_t k = 1; k < difference.size(); ++k) {
    EXPECT_NEAR(difference[k - 1] / difference[k], 8.0, 0.6);
  }
  EXPECT_LT(difference[0], 2e-3);
}

TEST(TangentPlaneField, DoesNotDependOnTheChoiceOfBases) {
  // Starting the triangle at another vertex, or turning everything, changes
  // every basis; the plane turns along.
  const std::array<Vector3d, 3> n = {Vector3d(0.5, 0.2, 1), Vector3d(0, 0.7, 1),
                                     Vector3d(-0.6, -0.4, 1)};
  const TangentPlaneCase s = OneTriangle(n);
  const Vector3d lambda(0.2, 0.5, 0.3);
  const Vector3d expected = TangentPlaneNormal(s.field, s.planes, 0, lambda);
  PhongField turned = s.field;
  turned.mesh.triangles[0] = {1, 2, 0};
  TangentPlaneCase r(turned);
  EXPECT_LT((TangentPlaneNormal(r.field, r.planes, 0, Vector3d(0.5, 0.3, 0.2)) -
             expected)
                .norm(),
            1e-13);
  const Eigen::Matrix3d turn = GenericRotation();
  PhongField rotated = s.field;
  for (Vector3d& m : rotated.normals) m = turn * m;
  TangentPlaneCase q(rotated);
  EXPECT_LT((TangentPlaneNormal(q.field, q.planes, 0, lambda) - turn * expected)
                .norm(),
            1e-13);
}

// Frames of normals more than 90° apart are reflections of each other; the
// normal still faces the linear one.
TEST(TangentPlaneField, NormalFacesTheLinearOneOfObtuseCorners) {
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int checked = 0;
  for (int i = 0; i < 1000; ++i) {
    std::array<Vector3d, 3> corners;
    for (Vector3d& n : corners) n = {uniform(rng), uniform(rng), uniform(rng)};
    const TangentPlaneCase s = OneTriangle(corners);
    const Vector3d lambda(0.2, 0.3, 0.5);
    const Vector3d n = TangentPlaneNormal(s.field, s.planes, 0, lambda);
    EXPECT_NEAR(n.norm(), 1.0, 1e-12);
    EXPECT_GE(n.dot(Linear(s.field, 0, lambda)), 0.0);
    ++checked;
  }
  EXPECT_EQ(checked, 1000);
}

}  // namespace
}  // namespace phongpd
