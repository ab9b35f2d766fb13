// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/smoothed_metric.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/contact/depth.h"
#include "core/mesh/mesh_error.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/count_allocations.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> RandomPoints(const TriangleMesh& mesh, int count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-0.1, 1.1);
  const BoundingBox box = ComputeBounds(mesh);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const Vector3d u(uniform(engine), uniform(engine), uniform(engine));
    points.push_back(box.min + u.cwiseProduct(box.max - box.min));
  }
  return points;
}

// −∇ of the occupancy around q that a grid of points samples: another route,
// by volume.  w' = −4r/ρ² (1 − r²/ρ²).
Vector3d ByVolume(const EuclideanMetric& metric, const Vector3d& q, double rho,
                  int steps) {
  const Eigen::Matrix3d turn = GenericRotation();
  Vector3d sum = Vector3d::Zero();
  const double step = 2.0 * rho / steps;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      for (int k = 0; k < steps; ++k) {
        // Turned, or a layer of it would lie along each wall.
        const Vector3d r = turn * (Vector3d(i + 0.5, j + 0.5, k + 0.5) * step -
                                   Vector3d::Constant(rho));
        const double s = r.squaredNorm() / (rho * rho);
        if (s < 1.0 && metric.Query(q + r).inside) sum -= (1.0 - s) * r;
      }
    }
  }
  return sum.normalized();
}

TEST(SmoothedMetric, HasEuclidsDepthAndAnotherDirection) {
  for (const TriangleMesh& mesh : {MakeU(2.0, 0.25, 0.5), MakeStar(1.0, 1.5)}) {
    const ContactSpace space = TakeAsContactSpace(mesh);
    const EuclideanMetric euclidean(space);
    for (const SmoothedAt at : {SmoothedAt::kPosition, SmoothedAt::kContact}) {
      const SmoothedMetric metric(space, 0.1, at);
      int inside = 0, turned = 0;
      for (const Vector3d& q : RandomPoints(mesh, 500)) {
        const PenetrationResult found = metric.Query(q);
        const PenetrationResult nearest = euclidean.Query(q);
        EXPECT_EQ(found.inside, nearest.inside);
        EXPECT_EQ(found.signed_distance, nearest.signed_distance);
        EXPECT_EQ(found.contact, nearest.contact);
        EXPECT_EQ(found.gradient, nearest.gradient);
        EXPECT_EQ(found.triangle, nearest.triangle);
        EXPECT_FALSE(found.branch.IsValid());
        EXPECT_NEAR(found.direction.norm(), 1.0, 1e-14);
        inside += found.inside ? 1 : 0;
        turned += (found.direction - nearest.direction).norm() > 1e-3 ? 1 : 0;
        if (!found.inside) {
          EXPECT_EQ(found.direction, nearest.direction);
          EXPECT_EQ(found.status, QueryStatus::kOk);
        }
      }
      EXPECT_GT(inside, 30);
      EXPECT_GT(turned, inside / 2);
    }
  }
}

TEST(SmoothedMetric, PointsWhereTheVolumeAroundItThinsOut) {
  const TriangleMesh mesh = MakeU(2.0, 0.25, 0.5);
  const ContactSpace space = TakeAsContactSpace(mesh);
  const EuclideanMetric euclidean(space);
  const double ell = 0.1;
  const double rho = 2.0 * ell * space.length();
  const SmoothedMetric at_q(space, ell);
  const SmoothedMetric at_foot(space, ell, SmoothedAt::kContact);
  int tested = 0;
  for (const Vector3d& q : RandomPoints(mesh, 400)) {
    const PenetrationResult found = at_q.Query(q);
    if (!found.inside || ++tested > 8) continue;
    EXPECT_LT((found.direction - ByVolume(euclidean, q, rho, 40)).norm(), 0.05);
    const PenetrationResult foot = at_foot.Query(q);
    EXPECT_LT(
        (foot.direction - ByVolume(euclidean, foot.contact, rho, 40)).norm(),
        0.05);
  }
  EXPECT_GE(tested, 8);
}

// Beyond ρ and where all cancels it says that the direction is Euclid's; on
// the way to ρ it becomes that one.
TEST(SmoothedMetric, SaysWhereTheDirectionIsEuclids) {
  const ContactSpace space = TakeAsContactSpace(MakeBox({0, 0, 0}, {4, 5, 6}));
  const EuclideanMetric euclidean(space);
  const double ell = 0.5 / space.length();  // ρ = 1
  const SmoothedMetric metric(space, ell);
  const Vector3d deep(1.5, 2.0, 3.0);
  EXPECT_EQ(metric.Query(deep).status, QueryStatus::kEuclideanFallback);
  EXPECT_EQ(metric.Query(deep).direction, euclidean.Query(deep).direction);
  for (const double depth : {0.5, 0.9, 0.99, 0.999}) {
    const PenetrationResult found = metric.Query({depth, 1.02 * depth, 3.0});
    EXPECT_EQ(found.status, QueryStatus::kOk) << depth;
    EXPECT_LT(found.direction.x(), -0.5);
  }
  EXPECT_EQ(metric.Query({0.99, 2, 3}).direction, -Vector3d::UnitX());
  // ρ = 4 sees both sides of the box's middle.
  const SmoothedMetric wide(space, 4.0 * ell);
  const PenetrationResult middle = wide.Query({2, 2.5, 3});
  EXPECT_EQ(middle.status, QueryStatus::kEuclideanFallback);
  EXPECT_NEAR(middle.direction.norm(), 1.0, 1e-15);
}

// Where Euclid's direction jumps by 90 degrees, that at q changes by 1e-3·C.
TEST(SmoothedMetric, IsContinuousAcrossTheMedialAxis) {
  const ContactSpace space = TakeAsContactSpace(MakeBox({0, 0, 0}, {4, 5, 6}));
  const EuclideanMetric euclidean(space);
  const SmoothedMetric metric(space, 0.2);
  double jumps = 0.0, most = 0.0;
  Vector3d last = Vector3d::Zero(), last_euclidean = Vector3d::Zero();
  for (int i = 0; i <= 1000; ++i) {
    const Vector3d q(0.5 + 0.5e-3 * i, 1.0 - 0.5e-3 * i, 3.0);
    const Vector3d now = metric.Query(q).direction;
    const Vector3d now_euclidean = euclidean.Query(q).direction;
    if (i > 0) {
      most = std::max(most, (now - last).norm());
      jumps = std::max(jumps, (now_euclidean - last_euclidean).norm());
    }
    last = now;
    last_euclidean = now_euclidean;
  }
  EXPECT_NEAR(jumps, std::sqrt(2.0), 1e-9);
  EXPECT_LT(most, 2e-3);
}

// A robot that turns moves C_cont continuously, and the direction with it.
TEST(SmoothedMetric, TurnsWithTheShapeAndScalesWithIt) {
  const TriangleMesh mesh = MakeWrench();
  const Eigen::Matrix3d turn = GenericRotation();
  TriangleMesh large = mesh;
  for (Vector3d& v : large.vertices) v *= 1024.0;
  const double ell = 0.2;
  const ContactSpace space = TakeAsContactSpace(mesh);
  const SmoothedMetric metric(space, ell),
      scaled(TakeAsContactSpace(large), ell),
      turned(TakeAsContactSpace(Rotated(mesh, turn)).WithLength(space.length()),
             ell);
  int tested = 0;
  for (const Vector3d& q : RandomPoints(mesh, 300)) {
    const PenetrationResult found = metric.Query(q);
    if (!found.inside) continue;
    ++tested;
    EXPECT_EQ(scaled.Query(1024.0 * q).direction, found.direction);
    EXPECT_LT(
        (turned.Query(turn * q).direction - turn * found.direction).norm(),
        1e-10);
  }
  EXPECT_GT(tested, 20);
}

TEST(SmoothedMetric, AnswersWithoutAllocationAndWithoutNaN) {
  const TriangleMesh mesh = MakeWrench();
  const SmoothedMetric metric(TakeAsContactSpace(mesh));
  const std::vector<Vector3d> points = RandomPoints(mesh, 200);
  double sum = 0.0;
  const long before = allocations;
  for (const Vector3d& q : points) sum += metric.Query(q).direction.x();
  EXPECT_EQ(allocations - before, 0);
  EXPECT_TRUE(std::isfinite(sum));
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {infinity, -infinity, std::nan("")}) {
    const PenetrationResult found = metric.Query({0, bad, 0});
    EXPECT_EQ(found.status, QueryStatus::kInvalid);
    EXPECT_EQ(found.direction, Vector3d::Zero());
    EXPECT_EQ(found.ToDepth().status, DepthStatus::kInvalid);
  }
  for (const double far : {1e200, 1e308}) {
    EXPECT_NEAR(metric.Query({far, far, -far}).direction.norm(), 1.0, 1e-14);
  }
}

TEST(SmoothedMetric, RefusesLengthsThatAreNone) {
  const ContactSpace space = TakeAsContactSpace(MakeIcoBall(1.0, 1));
  for (const double ell : {0.0, -0.1, 1e-12, 1.1, std::nan("")}) {
    EXPECT_THROW(SmoothedMetric(space, ell), InputError);
  }
  for (const double ell : {1e-9, 1.0}) {
    const SmoothedMetric metric(space, ell, SmoothedAt::kContact);
    EXPECT_EQ(metric.Query({0.1, 0.2, 0.3}).status, QueryStatus::kOk) << ell;
  }
}

}  // namespace
}  // namespace phongpd
