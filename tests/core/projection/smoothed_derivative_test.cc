// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: central differences of SmoothedNormals::At, and closed forms of a
// plane and of turned operands.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/pi.h"
#include "core/projection/smoothed_metric.h"
#include "core/projection/smoothed_normal.h"
#include "problems/shapes/shapes.h"
#include "tests/support/random_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d ByDifferences(const SmoothedNormals& normals, const Vector3d& x,
                       double h) {
  Matrix3d slope;
  for (int j = 0; j < 3; ++j) {
    const Vector3d e = h * Vector3d::Unit(j);
    slope.col(j) =
        (normals.At(x + e).integral - normals.At(x - e).integral) / (2.0 * h);
  }
  return slope;
}

// Second derivatives of w jump where a triangle meets the sphere's border, so
// differences are right to the order of h.
void Compare(const ContactSpace& space, double share, int points,
             std::mt19937_64* random, int* near) {
  const double rho = share * space.bounds().Diagonal();
  const SmoothedNormals normals(space, rho);
  for (int i = 0; i < points; ++i) {
    const Vector3d x = testing::RandomPoint(space.bounds(), random);
    const Matrix3d exact = normals.DerivativeAt(x);
    const Matrix3d found = ByDifferences(normals, x, 1e-5 * rho);
    EXPECT_LT((rho * (exact - found)).norm(), 2e-4) << x.transpose();
    // A gradient's derivative.
    EXPECT_LT(rho * (exact - exact.transpose()).norm(), 1e-11);
    *near += rho * exact.norm() > 1e-2 ? 1 : 0;
  }
}

TEST(SmoothedDerivative, IsThatOfCentralDifferences) {
  std::mt19937_64 random(3);
  int near = 0;
  for (const double share : {0.03, 0.1, 0.4, 1.5}) {
    Compare(TakeAsContactSpace(MakeKnot(1.0, 0.3, 48, 8)), share, 40, &random,
            &near);
    Compare(TakeAsContactSpace(MakeWrench()), share, 40, &random, &near);
    Compare(BuildContactSpace(MakeStar(0.5, 1.2), testing::Cube(1.0)), share,
            40, &random, &near);
  }
  EXPECT_GT(near, 120);
}

// Vertices, edges, planes of triangles, and 1e-12 beside them.
TEST(SmoothedDerivative, HoldsOnVerticesEdgesAndPlanes) {
  const ContactSpace space = TakeAsContactSpace(testing::Cube(2.0));
  const double rho = 0.7;
  const SmoothedNormals normals(space, rho);
  for (const Vector3d& x :
       {Vector3d(1, 1, 1), Vector3d(1, 1, 0.25), Vector3d(1, 0.3, 0.2),
        Vector3d(1, 0.2, 0.2), Vector3d(0.5, 1, 1)}) {
    for (const double beside : {0.0, 1e-12, -1e-12}) {
      const Vector3d y = x + beside * Vector3d(1, -2, 0.5);
      EXPECT_LT(
          (normals.DerivativeAt(y) - ByDifferences(normals, y, 1e-6)).norm(),
          1e-4)
          << y.transpose();
    }
  }
}

// At the height z over a plane G/ρ² = π/3 (1 − z²/ρ²)³ n.
TEST(SmoothedDerivative, IsTheClosedFormOfAHalfSpace) {
  const ContactSpace space = TakeAsContactSpace(testing::Cube(20.0));
  const double rho = 1.5;
  const SmoothedNormals normals(space, rho);
  for (const double z : {-1.4, -0.5, 0.0, 0.3, 1.2}) {
    const double share = 1.0 - z * z / (rho * rho);
    Matrix3d expected = Matrix3d::Zero();
    expected(2, 2) = -2.0 * kPi * z / (rho * rho) * share * share;
    EXPECT_LT((normals.DerivativeAt({0.1, -0.2, 10.0 + z}) - expected).norm(),
              1e-12)
        << z;
  }
}

TEST(SmoothedDerivative, IsZeroWhereNothingIsNearOrKnown) {
  const ContactSpace space = TakeAsContactSpace(testing::Cube(2.0));
  const SmoothedNormals normals(space, 0.1);
  EXPECT_TRUE(normals.DerivativeAt(Vector3d::Zero()).isZero(0.0));
  EXPECT_TRUE(normals.DerivativeAt({9, 9, 9}).isZero(0.0));
  EXPECT_TRUE(
      normals.DerivativeAt({0, std::numeric_limits<double>::quiet_NaN(), 0})
          .isZero(0.0));
}

// C_cont of a robot that turns moves continuously, and so does the direction
// at a place in it: half the angle, half the way, where none is unknown.
TEST(SmoothedMetric, IsContinuousInTheRotationOfTheRobot) {
  const TriangleMesh robot = testing::Cube(1.0), knot = MakeKnot(1, 0.3, 32, 6);
  const auto turned = [&](double angle) {
    const Eigen::AngleAxisd turn(angle, Vector3d(1, 2, 3).normalized());
    return BuildContactSpace(Rotated(robot, turn.toRotationMatrix()), knot)
        .WithLength(5.0);
  };
  const ContactSpace space = turned(0.4);
  const SmoothedMetric metric(space, 0.1);
  std::vector<Vector3d> places;
  for (std::size_t t = 0; t < space.normals().size(); t += 53) {
    const Triangle& corners = space.mesh().triangles[t];
    const Vector3d q =
        space.mesh().vertices[corners[0]] - 0.15 * space.normals()[t];
    const PenetrationResult at = metric.Query(q);
    if (at.inside && at.status == QueryStatus::kOk) places.push_back(q);
  }
  ASSERT_GT(places.size(), 10U);
  std::vector<double> before(places.size(), 2.0);
  for (const double step : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const SmoothedMetric beside(turned(0.4 + step), 0.1);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const PenetrationResult a = metric.Query(places[i]);
      const PenetrationResult b = beside.Query(places[i]);
      const double way = (a.direction - b.direction).norm();
      EXPECT_LT(way, 40.0 * step) << places[i].transpose();
      EXPECT_LT(way, 0.5 * before[i] + 1e-9) << places[i].transpose();
      before[i] = way;
      // No point of the robot moves by more than its corners do.
      EXPECT_NEAR(a.signed_distance, b.signed_distance, step);
    }
  }
}

}  // namespace
}  // namespace phongpd
