// SPDX-License-Identifier: GPL-3.0-or-later
// Cold queries and all projections.  Truth: every triangle of the field,
// Euclidean PD, the symmetry of ball and box.
#include "core/projection/phong_metric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/normal_field.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

PhongMetric MakeMetric(const TriangleMesh& mesh, double ell,
                       FieldKind kind = FieldKind::kNormal) {
  PhongMetricOptions options;
  options.field = kind;
  options.field_options.smoothing_length = ell;
  return PhongMetric(TakeAsContactSpace(mesh), options);
}

std::vector<Vector3d> InteriorPoints(const PhongMetric& metric,
                                     const TriangleMesh& mesh, int count) {
  std::mt19937 engine(12);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const BoundingBox box = ComputeBounds(mesh);
  std::vector<Vector3d> points;
  while (static_cast<int>(points.size()) < count) {
    const Vector3d u(uniform(engine), uniform(engine), uniform(engine));
    const Vector3d q = box.min + u.cwiseProduct(box.max - box.min);
    if (metric.IsInside(q)) points.push_back(q);
  }
  return points;
}

std::vector<TriangleMesh> QueriedShapes() {
  return {MakeIcoBall(1.0, 3),
          MakeL(2.0, 0.7, 0.6),
          Rotated(MakeU(2.0, 0.4, 0.6), GenericRotation()),
          MakeWrench(),
          MakeTorus(1.0, 0.3, 40, 16),
          MakeVessel(2.0, 1.0, 0.0)};
}

// Depths (user's unit) of all projections, ascending, by trying all triangles.
std::vector<double> BruteForce(const PhongMetric& metric,
                               const std::vector<OffsetPrism>& prisms,
                               const Vector3d& q) {
  std::vector<double> depths;
  std::array<NormalHit, 3> hits;
  for (const OffsetPrism& prism : prisms) {
    const int count =
        prism.Project(metric.field().ToField(q), -4.0, 0.0, &hits);
    for (int i = 0; i < count; ++i) {
      depths.push_back(-prism.SignedDepth(hits[i]) / metric.field().scale);
    }
  }
  std::sort(depths.begin(), depths.end());
  return depths;
}

TEST(PhongMetric, ColdQueryIsTheLeastDepthOfAllTriangles) {
  for (const TriangleMesh& mesh : QueriedShapes()) {
    const double diagonal = ComputeBounds(mesh).Diagonal();
    for (const double ell : {0.0, 0.1}) {
      const PhongMetric metric = MakeMetric(mesh, ell);
      const auto prisms = BuildOffsetPrisms(metric.field());
      for (const Vector3d& q : InteriorPoints(metric, mesh, 200)) {
        const PenetrationResult result = metric.Query(q);
        const std::vector<double> depths = BruteForce(metric, prisms, q);
        ASSERT_EQ(result.status == QueryStatus::kEuclideanFallback,
                  depths.empty());
        if (depths.empty()) continue;
        EXPECT_NEAR(-result.signed_distance, depths[0], 1e-12 * diagonal);
      }
    }
  }
}

TEST(PhongMetric, QueryAllListsEveryProjectionWithinTheBoundOnce) {
  for (const TriangleMesh& mesh : QueriedShapes()) {
    const double diagonal = ComputeBounds(mesh).Diagonal();
    const PhongMetric metric = MakeMetric(mesh, 0.05);
    const auto prisms = BuildOffsetPrisms(metric.field());
    std::vector<PenetrationResult> all;
    for (const Vector3d& q : InteriorPoints(metric, mesh, 60)) {
      const std::vector<double> truth = BruteForce(metric, prisms, q);
      for (const double bound : {0.02, 0.2, 1.0}) {
        metric.QueryAll(q, bound * diagonal, &all);
        std::vector<double> depths;
        for (const PenetrationResult& result : all) {
          depths.push_back(-result.signed_distance);
          EXPECT_LE(depths.back(), bound * diagonal * (1.0 + 1e-12));
        }
        EXPECT_TRUE(std::is_sorted(depths.begin(), depths.end()));
        for (const double depth : truth) {  // each depth is listed
          if (depth > bound * diagonal * (1.0 - 1e-12)) break;
          const auto at = std::lower_bound(depths.begin(), depths.end(),
                                           depth - 1e-9 * diagonal);
          ASSERT_NE(at, depths.end());
          EXPECT_NEAR(*at, depth, 1e-9 * diagonal);
        }
        EXPECT_LE(depths.size(), truth.size());
      }
      for (std::size_t i = 1; i < all.size(); ++i) {
        EXPECT_GT(
            (all[i].contact - all[i - 1].contact).norm() +
                std::abs(all[i].signed_distance - all[i - 1].signed_distance),
            1e-10 * diagonal);
      }
    }
  }
}

TEST(PhongMetric, HitIsAProjectionAndNotShallowerThanEuclidean) {
  for (const FieldKind kind : {FieldKind::kNormal, FieldKind::kTangentPlane}) {
    for (const TriangleMesh& mesh : QueriedShapes()) {
      const double diagonal = ComputeBounds(mesh).Diagonal();
      const PhongMetric metric = MakeMetric(mesh, 0.05, kind);
      const EuclideanMetric euclidean(TakeAsContactSpace(mesh));
      int missed = 0;
      for (const Vector3d& q : InteriorPoints(metric, mesh, 250)) {
        const PenetrationResult result = metric.Query(q);
        const PenetrationResult nearest = euclidean.Query(q);
        ASSERT_TRUE(result.inside);
        EXPECT_LE(result.signed_distance,
                  nearest.signed_distance + 1e-12 * diagonal);
        if (result.status != QueryStatus::kOk) {
          ++missed;
          EXPECT_EQ(result.status, QueryStatus::kEuclideanFallback);
          EXPECT_EQ(result.contact, nearest.contact);
          continue;
        }
        const Vector3d arrived = q - result.signed_distance * result.direction;
        EXPECT_LT((arrived - result.contact).norm(), 1e-9 * diagonal);
        EXPECT_NEAR(result.direction.norm(), 1.0, 1e-14);
        EXPECT_LT(std::abs(euclidean.Query(result.contact).signed_distance),
                  1e-14 * diagonal);
      }
      EXPECT_LE(missed, kind == FieldKind::kNormal ? 0 : 12);
    }
  }
}

TEST(PhongMetric, OutsideIsTheEuclideanMetricBitForBit) {
  const TriangleMesh mesh = MakeU(2.0, 0.4, 0.6);
  const PhongMetric phong = MakeMetric(mesh, 0.1);
  const EuclideanMetric euclidean(TakeAsContactSpace(mesh));
  std::mt19937 engine(13);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  for (int i = 0; i < 2000; ++i) {
    Vector3d q(uniform(engine), uniform(engine), uniform(engine));
    if (i < 28) q = mesh.vertices[i % mesh.vertices.size()];
    if (phong.IsInside(q)) continue;
    const PenetrationResult a = phong.Query(q), b = euclidean.Query(q);
    EXPECT_EQ(a.status, QueryStatus::kOk);
    EXPECT_EQ(a.signed_distance, b.signed_distance);
    EXPECT_EQ(a.contact, b.contact);
    EXPECT_EQ(a.gradient, b.gradient);
    EXPECT_FALSE(a.branch.IsValid());
  }
}

TEST(PhongMetric, IsRadialInABallAndStraightOnTheAxesOfABox) {
  const TriangleMesh ball = MakeIcoBall(2.0, 4);
  const PhongMetric radial = MakeMetric(ball, 0.0);
  for (const Vector3d& q : InteriorPoints(radial, ball, 1000)) {
    const PenetrationResult result = radial.Query(q);
    EXPECT_NEAR(-result.signed_distance, 2.0 - q.norm(), 6e-3);
    if (q.norm() > 0.2) {
      EXPECT_GT(result.direction.dot(q.normalized()), 0.999);
    }
  }
  const PhongMetric box = MakeMetric(MakeBox({-1, -1, -1}, {1, 1, 1}), 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double t : {-0.9, -0.5, -0.1, 0.3, 0.7, 0.999999}) {
      const Vector3d q = t * Vector3d::Unit(axis);
      const PenetrationResult result = box.Query(q);
      EXPECT_NEAR(result.signed_distance, std::abs(t) - 1.0, 1e-14);
      EXPECT_LT(
          (result.direction - std::copysign(1.0, t) * Vector3d::Unit(axis))
              .norm(),
          1e-12);
    }
  }
}

TEST(PhongMetric, ScalesBitForBitWithPowersOfTwo) {
  const TriangleMesh mesh = Rotated(MakeL(2.0, 0.7, 0.6), GenericRotation());
  const PhongMetric unit = MakeMetric(mesh, 0.05);
  const auto points = InteriorPoints(unit, mesh, 200);
  for (const int k : {-60, -1, 3, 60}) {
    const double factor = std::ldexp(1.0, k);
    const PhongMetric scaled = MakeMetric(Scaled(mesh, factor), 0.05);
    Branch branch, scaled_branch;
    for (const Vector3d& q : points) {
      // Every second query is warm.
      const PenetrationResult a = unit.Query(q, branch);
      const PenetrationResult b = scaled.Query(factor * q, scaled_branch);
      EXPECT_EQ(a.status, b.status);
      EXPECT_EQ(a.signed_distance * factor, b.signed_distance);
      EXPECT_EQ(Vector3d(a.contact * factor), b.contact);
      EXPECT_EQ(a.direction, b.direction);
      EXPECT_EQ(a.gradient, b.gradient);
      branch = branch.IsValid() ? Branch() : a.branch;
      scaled_branch = scaled_branch.IsValid() ? Branch() : b.branch;
    }
  }
}

TEST(PhongMetric, DoesNotDependOnTheOrderOfTriangles) {
  std::mt19937 engine(14);
  for (const TriangleMesh& mesh :
       {MakeL(2.0, 0.7, 0.6), MakeBox({-1, -1, -1}, {1, 1, 1}),
        MakeTorus(1.0, 0.3, 24, 12)}) {
    const double diagonal = ComputeBounds(mesh).Diagonal();
    TriangleMesh shuffled = mesh;
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), engine);
    const PhongMetric a = MakeMetric(mesh, 0.0);
    const PhongMetric b = MakeMetric(shuffled, 0.0);
    auto points = InteriorPoints(a, mesh, 500);
    points.emplace_back(0.5, 0.25, 0.3);  // on planes of symmetry
    points.emplace_back(0.25, 0.25, 0.3);
    for (const Vector3d& q : points) {
      if (!a.IsInside(q)) continue;
      EXPECT_LT((a.Query(q).contact - b.Query(q).contact).norm(),
                1e-11 * diagonal)
          << q.transpose();
    }
  }
}

TEST(PhongMetric, RefusesWhatItCannotAnswer) {
  const PhongMetric metric = MakeMetric(MakeIcoBall(1.0, 2), 0.0);
  std::vector<PenetrationResult> all(3);
  for (const double bad : {NAN, INFINITY, -INFINITY}) {
    const Vector3d q(0.0, bad, 0.0);
    EXPECT_EQ(metric.Query(q).status, QueryStatus::kInvalid);
    EXPECT_FALSE(metric.IsInside(q));
    metric.QueryAll(q, 1.0, &all);
    EXPECT_TRUE(all.empty());
    Branch branch = metric.Query(Vector3d(0.1, 0.2, 0.3)).branch;
    ASSERT_TRUE(branch.IsValid());
    branch.s = bad;  // not a branch of this metric: cold
    EXPECT_EQ(metric.Query(Vector3d(0.1, 0.2, 0.3), branch).status,
              QueryStatus::kOk);
    branch.triangle = 1 << 30;
    EXPECT_EQ(metric.Query(Vector3d(0.1, 0.2, 0.3), branch).status,
              QueryStatus::kOk);
  }
  // The centre, where all triangles collapse: some finite answer.
  const PenetrationResult centre = metric.Query(Vector3d::Zero());
  EXPECT_TRUE(centre.contact.allFinite() && centre.gradient.allFinite());
  EXPECT_NEAR(centre.direction.norm(), 1.0, 1e-12);
  EXPECT_THROW(MakeMetric(TriangleMesh{}, 0.0), InputError);
  EXPECT_THROW(MakeMetric(MakeIcoBall(1.0, 2), 2.0), InputError);
}

}  // namespace
}  // namespace phongpd
