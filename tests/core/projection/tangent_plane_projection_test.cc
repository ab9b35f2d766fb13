// SPDX-License-Identifier: GPL-3.0-or-later
// Projection along the normals of tangent planes: what Newton finds, and the
// gradient of the depth there.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/projection/field_projector.h"
#include "core/projection/tangent_plane_field.h"
#include "tests/support/tangent_plane_cases.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::At;
using testing::Linear;
using testing::OnEdge;
using testing::OneTriangle;
using testing::Point;
using testing::TangentPlaneCase;
using testing::TangentPlaneCases;

const Vector3d kThird = Vector3d::Constant(1.0 / 3.0);

TEST(TangentPlaneProjection, NewtonFindsThePointsItWasGiven) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int tried = 0;
  int from_centroid = 0;
  for (const TangentPlaneCase& s : TangentPlaneCases()) {
    for (int t = 0; t < static_cast<int>(s.planes.frames.size()); t += 3) {
      Vector3d lambda(unit(rng), unit(rng), unit(rng));
      lambda /= lambda.sum();
      const double depth = -0.05 * unit(rng);
      const Vector3d n = TangentPlaneNormal(s.field, s.planes, t, lambda);
      const Vector3d x = Point(s.field, t, lambda) + depth * n;
      TangentPlaneHit hit;
      ++tried;
      // Its own λ is a root: one step, and it stays.
      ASSERT_TRUE(
          ProjectOnTangentPlanes(s.field, s.planes, t, x, lambda, &hit));
      EXPECT_LT((hit.lambda - lambda).norm(), 1e-9);
      EXPECT_NEAR(hit.s, depth, 1e-11);
      EXPECT_LT((hit.normal - n).norm(), 1e-8);
      if (!ProjectOnTangentPlanes(s.field, s.planes, t, x, kThird, &hit)) {
        continue;
      }
      ++from_centroid;
      // Residual of what it found, by the definition.
      EXPECT_NEAR(hit.lambda.sum(), 1.0, 1e-12);
      EXPECT_GE(hit.lambda.minCoeff(), -1e-9);
      const Vector3d back = Point(s.field, t, hit.lambda) + hit.s * hit.normal;
      EXPECT_LT((back - x).norm(), 1e-12);
      EXPECT_LT(
          (hit.normal - TangentPlaneNormal(s.field, s.planes, t, hit.lambda))
              .norm(),
          1e-14);
    }
  }
  EXPECT_GT(tried, 300);
  EXPECT_GE(from_centroid, static_cast<int>(0.99 * tried));
}

TEST(TangentPlaneProjection, ProjectsOntoVerticesAndEdges) {
  int tried = 0;
  int from_centroid = 0;
  for (const TangentPlaneCase& s : TangentPlaneCases()) {
    for (int t = 0; t < static_cast<int>(s.planes.frames.size()); t += 5) {
      for (int k = 0; k < 3; ++k) {
        for (const double u : {0.0, 1e-12, 1e-7, 0.4}) {
          const Vector3d lambda = OnEdge(k, u);
          const Vector3d x =
              Point(s.field, t, lambda) - 0.001 * Linear(s.field, t, lambda);
          TangentPlaneHit hit;
          ++tried;
          if (ProjectOnTangentPlanes(s.field, s.planes, t, x, kThird, &hit)) {
            ++from_centroid;
          }
          ASSERT_TRUE(ProjectOnTangentPlanes(
              s.field, s.planes, t, x,
              Vector3d(lambda + 0.02 * (kThird - lambda)), &hit));
          EXPECT_LT((hit.lambda - lambda).norm(), 1e-9);
          EXPECT_NEAR(hit.s, -0.001, 1e-11);
          EXPECT_NEAR(hit.gradient.dot(hit.normal), 1.0, 1e-9);
        }
      }
    }
  }
  // What Newton from the centroid misses (the paper's start) is known.
  EXPECT_GT(from_centroid, static_cast<int>(0.99 * tried));
}

TEST(TangentPlaneProjection, GradientAgreesWithCentralDifferences) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> unit(0.05, 1.0);
  int compared = 0;
  for (const TangentPlaneCase& s : TangentPlaneCases()) {
    for (int t = 0; t < static_cast<int>(s.planes.frames.size()); t += 11) {
      Vector3d lambda(unit(rng), unit(rng), unit(rng));
      lambda /= lambda.sum();
      const double edge =
          (s.field.mesh.vertices[At(s.field.mesh.triangles[At(t)][1])] -
           s.field.mesh.vertices[At(s.field.mesh.triangles[At(t)][0])])
              .norm();
      const Vector3d x =
          Point(s.field, t, lambda) -
          0.1 * edge * TangentPlaneNormal(s.field, s.planes, t, lambda);
      TangentPlaneHit hit;
      ASSERT_TRUE(
          ProjectOnTangentPlanes(s.field, s.planes, t, x, lambda, &hit));
      // Along the projection direction the depth changes one to one.
      EXPECT_NEAR(hit.gradient.dot(hit.normal), 1.0, 1e-10);
      const double h = 1e-5 * edge;
      Vector3d difference;
      bool complete = true;
      for (Eigen::Index k = 0; k < 3; ++k) {
        TangentPlaneHit plus, minus;
        complete &= ProjectOnTangentPlanes(
            s.field, s.planes, t, x + h * Vector3d::Unit(k), lambda, &plus);
        complete &= ProjectOnTangentPlanes(
            s.field, s.planes, t, x - h * Vector3d::Unit(k), lambda, &minus);
        difference[k] = (plus.s - minus.s) / (2.0 * h);
      }
      ASSERT_TRUE(complete);
      EXPECT_LT((hit.gradient - difference).norm(), 1e-6 * hit.gradient.norm());
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

TEST(TangentPlaneProjection, FailureLeavesTheHitAlone) {
  const TangentPlaneCase s =
      OneTriangle({Vector3d::UnitZ(), Vector3d::UnitZ(), Vector3d::UnitZ()});
  TangentPlaneHit hit;
  hit.s = 42.0;
  EXPECT_FALSE(ProjectOnTangentPlanes(s.field, s.planes, 0, Vector3d(5, 5, 0),
                                      kThird, &hit));
  EXPECT_FALSE(ProjectOnTangentPlanes(
      s.field, s.planes, 0, Vector3d::Constant(std::nan("")), kThird, &hit));
  EXPECT_EQ(hit.s, 42.0);
  EXPECT_TRUE(ProjectOnTangentPlanes(s.field, s.planes, 0,
                                     Vector3d(0.4, 0.3, -2.0), kThird, &hit));
  EXPECT_DOUBLE_EQ(hit.s, -2.0);
  EXPECT_LT((hit.gradient - Vector3d::UnitZ()).norm(), 1e-15);
}

// Down the line of a projection the gradient grows without bound towards a
// fold, and its part across the normal changes sign there.
TEST(TangentPlaneProjection, GradientStaysFiniteUpToFoldsAndIsTheNormalThere) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  int folds = 0, normals = 0;
  double longest = 0.0;
  for (int i = 0; i < 300; ++i) {
    std::array<Vector3d, 3> corners;
    for (Vector3d& n : corners) n = {uniform(rng), uniform(rng), 1.0};
    const FieldProjector projector(OneTriangle(corners).field,
                                   FieldKind::kTangentPlane);
    const Vector3d lambda(0.3, 0.3, 0.4);
    const Vector3d normal = projector.UnitNormal({0, lambda, 0.0, 0.0});
    const auto gradient = [&](double s) {
      const Vector3d g = projector.Gradient({0, lambda, s, -s});
      EXPECT_TRUE(g.allFinite());
      EXPECT_GT(g.norm(), 0.99);
      normals += g == normal ? 1 : 0;
      longest = std::max(longest, g.norm());
      return g;
    };
    const auto side = [&](double s) {
      return (gradient(s) - normal).dot(gradient(-0.1) - normal) > 0.0;
    };
    double near = -0.1, far = -0.2;
    while (far > -5.0 && side(far)) far -= 0.1;
    if (far <= -5.0) continue;
    ++folds;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (near + far);
      (side(middle) ? near : far) = middle;
    }
    for (const double offset : {0.0, 1e-12, -1e-12}) gradient(near + offset);
  }
  EXPECT_GT(folds, 100);
  EXPECT_GT(normals, 20);
  EXPECT_GT(longest, 1e6);
}

TEST(FieldProjector, NormalAndGradientAreZeroWhereNormalsCancel) {
  const FieldProjector projector(
      OneTriangle({Vector3d::UnitZ(), -Vector3d::UnitZ(), Vector3d::UnitZ()})
          .field,
      FieldKind::kNormal);
  const Projection middle{0, Vector3d(0.5, 0.5, 0.0), -0.5, 0.0};
  EXPECT_EQ(projector.UnitNormal(middle), Vector3d::Zero());
  EXPECT_EQ(projector.Gradient(middle), Vector3d::Zero());
}

}  // namespace
}  // namespace phongpd
