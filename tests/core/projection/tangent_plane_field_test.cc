// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/tangent_plane_field.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/projection/field_projector.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

const Vector3d kThird = Vector3d::Constant(1.0 / 3.0);

std::size_t At(int k) { return static_cast<std::size_t>(k); }

struct Case {
  PhongField field;
  TangentPlaneField planes;

  explicit Case(PhongField f)
      : field(std::move(f)), planes(BuildTangentPlaneField(field)) {}
};

std::vector<Case> Fields() {
  const Eigen::Matrix3d turn = GenericRotation();
  std::vector<Case> result;
  for (const double ell : {0.0, 0.15}) {
    PhongFieldOptions options;
    options.smoothing_length = ell;
    for (const TriangleMesh& mesh :
         {MakeBox(Vector3d(0, 0, 0), Vector3d(1, 2, 3)),
          Rotated(MakeU(1.0, 0.2, 0.5), turn), MakeStar(1.0, 2.0),
          Rotated(MakeCone(1.0, 2.0, 12), turn), MakeIcoBall(1.0, 2)}) {
      result.emplace_back(BuildPhongField(TakeAsContactSpace(mesh), options));
    }
  }
  return result;
}

// A field of one triangle with the given vertex normals.
Case OneTriangle(const std::array<Vector3d, 3>& normals) {
  PhongField field;
  field.mesh.vertices = {Vector3d(0, 0, 0), Vector3d(1, 0.1, 0),
                         Vector3d(0.2, 0.9, 0)};
  field.mesh.triangles = {{0, 1, 2}};
  for (const Vector3d& n : normals) field.normals.push_back(n.normalized());
  return Case(field);
}

Vector3d Linear(const PhongField& field, int t, const Vector3d& lambda) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    sum += lambda[static_cast<Eigen::Index>(k)] *
           field.normals[At(field.mesh.triangles[At(t)][k])];
  }
  return sum.normalized();
}

Vector3d Point(const PhongField& field, int t, const Vector3d& lambda) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    sum += lambda[static_cast<Eigen::Index>(k)] *
           field.mesh.vertices[At(field.mesh.triangles[At(t)][k])];
  }
  return sum;
}

Vector3d OnEdge(int k, double u) {
  Vector3d lambda = Vector3d::Zero();
  lambda[k] = 1.0 - u;
  lambda[(k + 1) % 3] = u;
  return lambda;
}

TEST(TangentPlaneField, BasesAreOrthonormalAndRightHanded) {
  for (const Case& s : Fields()) {
    for (std::size_t v = 0; v < s.planes.bases.size(); ++v) {
      const auto& basis = s.planes.bases[v];
      EXPECT_TRUE((basis * basis.transpose()).isIdentity(1e-14));
      const Vector3d cross = basis.row(0).cross(basis.row(1)).transpose();
      EXPECT_LT((cross - s.field.normals[v]).norm(), 1e-14);
    }
  }
}

TEST(TangentPlaneField, PlaneAtAVertexIsThatOfTheVertex) {
  for (const Case& s : Fields()) {
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
  for (const Case& s : Fields()) {
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
  for (const Case& s : Fields()) {
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
    const Case s = OneTriangle({Vector3d(z + angle * lean[0]),
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
  const Case s = OneTriangle(n);
  const Vector3d lambda(0.2, 0.5, 0.3);
  const Vector3d expected = TangentPlaneNormal(s.field, s.planes, 0, lambda);
  PhongField turned = s.field;
  turned.mesh.triangles[0] = {1, 2, 0};
  Case r(turned);
  EXPECT_LT((TangentPlaneNormal(r.field, r.planes, 0, Vector3d(0.5, 0.3, 0.2)) -
             expected)
                .norm(),
            1e-13);
  const Eigen::Matrix3d turn = GenericRotation();
  PhongField rotated = s.field;
  for (Vector3d& m : rotated.normals) m = turn * m;
  Case q(rotated);
  EXPECT_LT((TangentPlaneNormal(q.field, q.planes, 0, lambda) - turn * expected)
                .norm(),
            1e-13);
}

TEST(TangentPlaneField, NewtonFindsThePointsItWasGiven) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int tried = 0;
  int from_centroid = 0;
  for (const Case& s : Fields()) {
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

TEST(TangentPlaneField, ProjectsOntoVerticesAndEdges) {
  int tried = 0;
  int from_centroid = 0;
  for (const Case& s : Fields()) {
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

TEST(TangentPlaneField, GradientAgreesWithCentralDifferences) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> unit(0.05, 1.0);
  int compared = 0;
  for (const Case& s : Fields()) {
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

TEST(TangentPlaneField, FailureLeavesTheHitAlone) {
  const Case s =
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
TEST(TangentPlaneField, GradientStaysFiniteUpToFoldsAndIsTheNormalThere) {
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

// Frames of normals more than 90° apart are reflections of each other; the
// normal still faces the linear one.
TEST(TangentPlaneField, NormalFacesTheLinearOneOfObtuseCorners) {
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int checked = 0;
  for (int i = 0; i < 1000; ++i) {
    std::array<Vector3d, 3> corners;
    for (Vector3d& n : corners) n = {uniform(rng), uniform(rng), uniform(rng)};
    const Case s = OneTriangle(corners);
    const Vector3d lambda(0.2, 0.3, 0.5);
    const Vector3d n = TangentPlaneNormal(s.field, s.planes, 0, lambda);
    EXPECT_NEAR(n.norm(), 1.0, 1e-12);
    EXPECT_GE(n.dot(Linear(s.field, 0, lambda)), 0.0);
    ++checked;
  }
  EXPECT_EQ(checked, 1000);
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
