// SPDX-License-Identifier: GPL-3.0-or-later
// Truth by other routes: central differences, intervals of boxes, and the scan
// of all triangles.
#include "constraints/signed_metric.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr MetricKind kAllKinds[] = {MetricKind::kPhong, MetricKind::kEuclidean,
                                    MetricKind::kSmoothed,
                                    MetricKind::kSmoothedFoot};

SignedMetricOptions Options(MetricKind metric, JacobianKind jacobian) {
  SignedMetricOptions options;
  options.metric = metric;
  options.jacobian = jacobian;
  return options;
}

TriangleMesh TurnedU() {
  return Rotated(MakeU(1.0, 0.2, 0.6), GenericRotation());
}

Vector3d RandomPoint(const BoundingBox& box, double grow,
                     std::mt19937_64* random) {
  std::uniform_real_distribution<double> uniform(-0.5 - grow, 0.5 + grow);
  Vector3d q;
  for (int i = 0; i < 3; ++i) {
    q[i] = box.Center()[i] + uniform(*random) * (box.max - box.min)[i];
  }
  return q;
}

TEST(SignedMetric, IsTheIntervalDistanceOfABox) {
  for (const MetricKind kind : kAllKinds) {
    const SignedMetric metric(
        TakeAsContactSpace(MakeBox({-1, -1, -1}, {1, 1, 1})),
        Options(kind, JacobianKind::kDirection));
    EXPECT_NEAR(metric.Query({2.5, 0.2, 0.1}).value, 1.5, 1e-14);
    EXPECT_NEAR(metric.Query({2.0, 2.0, 0.1}).value, std::sqrt(2.0), 1e-14);
    const MetricRow inside = metric.Query({0.9, 0.0, 0.0});
    EXPECT_TRUE(inside.inside);
    EXPECT_NEAR(inside.value, -0.1, kind == MetricKind::kPhong ? 0.05 : 1e-14);
    EXPECT_GT(inside.gradient.x(), 0.9);  // outward
    EXPECT_EQ(metric.Query({1.0, 0.3, 0.2}).value, 0.0);
  }
}

// Steps of 1e-6 of the size, over which few of the random points have a kink.
TEST(SignedMetric, ExactJacobianIsTheDerivative) {
  const TriangleMesh mesh = TurnedU();
  for (const MetricKind kind : kAllKinds) {
    const SignedMetric metric(TakeAsContactSpace(mesh),
                              Options(kind, JacobianKind::kExact));
    std::mt19937_64 random(3);
    int compared = 0, off = 0, inside = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3d q = RandomPoint(metric.space().bounds(), 0.2, &random);
      const MetricRow row = metric.Query(q);
      if (row.is_capped) continue;
      Vector3d difference;
      const double h = 1e-6;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d step = h * Vector3d::Unit(axis);
        MetricRow ahead, behind;
        metric.Query(q + step, row.branch, 1, &ahead);
        metric.Query(q - step, row.branch, 1, &behind);
        difference[axis] = (ahead.value - behind.value) / (2.0 * h);
      }
      ++compared;
      inside += row.inside ? 1 : 0;
      off += (difference - row.gradient).norm() > 1e-6 ? 1 : 0;
    }
    EXPECT_GT(inside, 60);
    EXPECT_GT(compared, 1980);
    EXPECT_LE(off, 3);  // points with a kink within the step
  }
}

// n̂·∇d = 1, so the angle between the two is acos(1/|∇d|); this records how
// large it becomes on the U at ℓ = 0.2.
TEST(SignedMetric, DirectionPointsUphill) {
  const TriangleMesh mesh = TurnedU();
  const SignedMetric exact(TakeAsContactSpace(mesh),
                           Options(MetricKind::kPhong, JacobianKind::kExact));
  const SignedMetric direction(
      TakeAsContactSpace(mesh),
      Options(MetricKind::kPhong, JacobianKind::kDirection));
  std::mt19937_64 random(4);
  std::vector<double> degrees;
  for (int i = 0; i < 6000; ++i) {
    const Vector3d q = RandomPoint(exact.space().bounds(), 0.0, &random);
    const MetricRow e = exact.Query(q), d = direction.Query(q);
    EXPECT_EQ(e.value, d.value);
    if (!e.inside || e.status != QueryStatus::kOk) continue;
    EXPECT_NEAR(d.gradient.norm(), 1.0, 1e-12);
    if (e.is_capped) {
      EXPECT_NEAR(e.gradient.norm(), kMaxRowGradient, 1e-12);
      continue;
    }
    EXPECT_NEAR(d.gradient.dot(e.gradient), 1.0, 1e-6);
    const double cosine = d.gradient.dot(e.gradient) / e.gradient.norm();
    degrees.push_back(std::acos(std::min(1.0, cosine)) * 180.0 / kPi);
  }
  ASSERT_GT(degrees.size(), 400u);
  std::sort(degrees.begin(), degrees.end());
  EXPECT_LT(degrees[degrees.size() / 2], 35.0);
  EXPECT_GT(degrees[degrees.size() / 2], 25.0);
  EXPECT_LT(degrees.back(), 90.0);
}

// The value is continuous and 1-Lipschitz outside; the direction stays unit
// and finite at, and beside, vertices, edges and the surface.
TEST(SignedMetric, IsSoundOnAndBesideFeatures) {
  const TriangleMesh mesh = MakeBox({-1, -1, -1}, {1, 1, 1});
  for (const MetricKind kind : kAllKinds) {
    const SignedMetric metric(TakeAsContactSpace(mesh),
                              Options(kind, JacobianKind::kExact));
    int sides[2] = {0, 0};
    for (const Vector3d& feature :
         {Vector3d(1, 1, 1), Vector3d(1, 1, 0.3), Vector3d(1, 0.2, 0.3),
          Vector3d(1, 0.3, 0.3), Vector3d(1, -0.3, 0.3)}) {
      for (const double step : {0.0, 1e-12, -1e-12, 1e-15, -1e-15}) {
        for (int axis = 0; axis < 3; ++axis) {
          const Vector3d q = feature + step * Vector3d::Unit(axis);
          MetricRow rows[3];
          metric.Query(q, Branch(), 3, rows);
          ++sides[rows[0].inside ? 1 : 0];
          EXPECT_LE(std::abs(rows[0].value), 2e-12);
          EXPECT_EQ(rows[0].inside, q.cwiseAbs().maxCoeff() < 1.0);
          for (const MetricRow& row : rows) {
            EXPECT_TRUE(row.gradient.allFinite());
            EXPECT_GT(row.gradient.norm(), 0.9);
          }
        }
      }
    }
    EXPECT_GT(sides[0], 20);
    EXPECT_GT(sides[1], 5);
  }
}

TEST(SignedMetric, HoldsNoNanForAnyInput) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const MetricKind kind : kAllKinds) {
    const SignedMetric metric(TakeAsContactSpace(TurnedU()),
                              Options(kind, JacobianKind::kExact));
    for (const double x :
         {inf, -inf, nan, 1e308, -1e308, 1e200, 1e9, 1e-308, 5e-324, 0.0}) {
      for (const Vector3d& q :
           {Vector3d(x, 0, 0), Vector3d(x, x, x), Vector3d(0.1, x, -x)}) {
        MetricRow rows[4];
        metric.Query(q, Branch(), 4, rows);
        for (const MetricRow& row : rows) {
          EXPECT_TRUE(std::isfinite(row.value)) << q.transpose();
          EXPECT_TRUE(row.gradient.allFinite()) << q.transpose();
          if (!q.allFinite()) {
            EXPECT_EQ(row.status, QueryStatus::kInvalid);
            EXPECT_EQ(row.value, 0.0);
          }
        }
      }
    }
  }
}

// Greedy scan of every triangle, sorted by distance; only the first may be
// farther than `reach`.
std::vector<MetricRow> BruteForceRows(const TriangleMesh& mesh,
                                      const Vector3d& q, double degrees,
                                      double reach, int count) {
  std::vector<MetricRow> all;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                   &c = mesh.vertices[t[2]];
    const TrianglePoint p = ClosestOnTriangle(a, b, c, q);
    MetricRow row;
    const Vector3d difference =
        q - (p.lambda[0] * a + p.lambda[1] * b + p.lambda[2] * c);
    row.value = difference.norm();
    row.gradient = difference.normalized();
    all.push_back(row);
  }
  std::stable_sort(
      all.begin(), all.end(),
      [](const MetricRow& a, const MetricRow& b) { return a.value < b.value; });
  std::vector<MetricRow> kept;
  for (const MetricRow& row : all) {
    const bool is_new =
        std::all_of(kept.begin(), kept.end(), [&](const MetricRow& k) {
          return k.gradient.dot(row.gradient) < std::cos(degrees * kPi / 180.0);
        });
    const bool is_near = kept.empty() || row.value <= reach;
    if (is_new && is_near && static_cast<int>(kept.size()) < count) {
      kept.push_back(row);
    }
  }
  return kept;
}

TEST(SignedMetric, RowsEqualTheScanOfAllTriangles) {
  const TriangleMesh mesh =
      Rotated(MakePlateWithHole(2.0, 0.2, 0.4), GenericRotation());
  const SignedMetricOptions options =
      Options(MetricKind::kEuclidean, JacobianKind::kDirection);
  // Rows reach as far as a tenth, a half and thousands of the diagonal.
  const ContactSpace space = TakeAsContactSpace(mesh);
  std::vector<SignedMetric> metrics;
  for (const double diagonals : {1.0, 5.0, 1e5}) {
    metrics.emplace_back(space.WithLength(diagonals * space.length()), options);
  }
  std::mt19937_64 random(5);
  int extra = 0, repeated = 0;
  for (int i = 0; i < 3000; ++i) {
    const SignedMetric& metric = metrics[i % 3];
    const Vector3d q = RandomPoint(metric.space().bounds(),
                                   i / 3 % 2 == 0 ? 0.0 : 4.0, &random);
    MetricRow rows[4];
    metric.Query(q, Branch(), 4, rows);
    if (rows[0].inside) {
      for (int k = 1; k < 4; ++k) {
        EXPECT_TRUE(rows[k].is_repeated);
        EXPECT_EQ(rows[k].value, rows[0].value);
        EXPECT_EQ(rows[k].gradient, rows[0].gradient);
      }
      continue;
    }
    const std::vector<MetricRow> expected =
        BruteForceRows(mesh, q, 25.0, 0.1 * metric.space().length(), 4);
    for (std::size_t k = 0; k < 4; ++k) {
      if (k >= expected.size()) {
        EXPECT_TRUE(rows[k].is_repeated);
        ++repeated;
        continue;
      }
      EXPECT_FALSE(rows[k].is_repeated);
      EXPECT_NEAR(rows[k].value, expected[k].value, 1e-12);
      extra += k > 0 ? 1 : 0;
      for (std::size_t j = 0; j < k; ++j) {
        EXPECT_LT(rows[k].gradient.dot(rows[j].gradient),
                  std::cos(25.0 * kPi / 180.0) + 1e-9);
      }
    }
  }
  EXPECT_GT(extra, 1500);
  EXPECT_GT(repeated, 500);
}

// Every further row is a necessary condition of the same constraint.
TEST(SignedMetric, FurtherRowsAreNeverLess) {
  const SignedMetric metric(
      TakeAsContactSpace(TurnedU()),
      Options(MetricKind::kEuclidean, JacobianKind::kExact));
  std::mt19937_64 random(6);
  for (int i = 0; i < 2000; ++i) {
    MetricRow rows[3];
    metric.Query(RandomPoint(metric.space().bounds(), 0.5, &random), Branch(),
                 3, rows);
    EXPECT_GE(rows[1].value, rows[0].value - 1e-12);
    EXPECT_GE(rows[2].value, rows[rows[2].is_repeated ? 0 : 1].value - 1e-12);
  }
}

TEST(SignedMetric, ScalesBitForBitWithTheInput) {
  const TriangleMesh mesh = TurnedU();
  const SignedMetricOptions options =
      Options(MetricKind::kPhong, JacobianKind::kDirection);
  const SignedMetric metric(TakeAsContactSpace(mesh), options);
  const SignedMetric scaled(TakeAsContactSpace(Scaled(mesh, 1024.0)), options);
  std::mt19937_64 random(7);
  for (int i = 0; i < 300; ++i) {
    const Vector3d q = RandomPoint(metric.space().bounds(), 0.3, &random);
    MetricRow a[3], b[3];
    metric.Query(q, Branch(), 3, a);
    scaled.Query(1024.0 * q, Branch(), 3, b);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(1024.0 * a[k].value, b[k].value);
      EXPECT_EQ(a[k].gradient, b[k].gradient);
    }
  }
}

TEST(SignedMetric, FollowsAMetricOfOnesOwn) {
  const ContactSpace space = TakeAsContactSpace(TurnedU());
  const auto own = std::make_shared<EuclideanMetric>(space);
  const SignedMetric with_own(space, own, {});  // options say Phong
  const SignedMetric euclidean(
      space, Options(MetricKind::kEuclidean, JacobianKind::kDirection));
  std::mt19937_64 random(9);
  for (int i = 0; i < 500; ++i) {
    const Vector3d q = RandomPoint(space.bounds(), 0.2, &random);
    MetricRow a[2], b[2];
    with_own.Query(q, Branch(), 2, a);
    euclidean.Query(q, Branch(), 2, b);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(a[k].value, b[k].value);
      EXPECT_EQ(a[k].gradient, b[k].gradient);
      EXPECT_EQ(a[k].is_repeated, b[k].is_repeated);
    }
  }
  EXPECT_THROW(SignedMetric(space, nullptr, {}), InputError);
}

TEST(SignedMetric, NamesBadOptions) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  SignedMetricOptions options;
  options.phong.field_options.smoothing_length = -1.0;
  EXPECT_THROW(SignedMetric(TakeAsContactSpace(box), options), InputError);
  TriangleMesh open = box;
  open.triangles.pop_back();
  EXPECT_THROW(SignedMetric(TakeAsContactSpace(open), {}), InputError);
}

}  // namespace
}  // namespace phongpd
