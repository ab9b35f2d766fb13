// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: points built from chosen (λ, s); Newton from many starts; central
// differences.
#include "core/projection/normal_field.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

namespace phongpd {
namespace {

using Eigen::Vector3d;

class RandomPrisms {
 public:
  explicit RandomPrisms(unsigned seed) : engine_(seed) {}

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vector3d Point() { return {Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1)}; }
  // A triangle with unit normals within `spread` of a common direction.
  OffsetPrism Prism(double spread) {
    const Vector3d axis = Point().normalized();
    return OffsetPrism({Point(), Point(), Point()},
                       {(axis + spread * Point()).normalized(),
                        (axis + spread * Point()).normalized(),
                        (axis + spread * Point()).normalized()});
  }
  Vector3d Lambda() {
    Vector3d lambda(Uniform(0, 1), Uniform(0, 1), Uniform(0, 1));
    return lambda / lambda.sum();
  }

 private:
  std::mt19937 engine_;
};

Vector3d At(const OffsetPrism& prism, const NormalHit& hit) {
  return prism.Point(hit.lambda) + hit.s * prism.Normal(hit.lambda);
}

double DistanceToHits(const OffsetPrism& prism, const Vector3d& x,
                      const NormalHit& truth) {
  std::array<NormalHit, 3> hits;
  const int count = prism.Project(x, -3.0, 3.0, &hits);
  double distance = 1e300;
  for (int i = 0; i < count; ++i) {
    distance = std::min(distance, (hits[i].lambda - truth.lambda).norm() +
                                      std::abs(hits[i].s - truth.s));
  }
  return distance;
}

TEST(NormalField, FindsEveryConstructedProjection) {
  RandomPrisms random(5);
  int checked = 0;
  for (int i = 0; i < 20000; ++i) {
    const OffsetPrism prism = random.Prism(i % 2 ? 0.4 : 0.02);
    const NormalHit truth{random.Lambda(), random.Uniform(-2.0, 2.0)};
    const double det = prism.Jacobian(truth).determinant();
    if (std::abs(det) < 1e-3) continue;  // near a fold: next test
    ++checked;
    EXPECT_LT(DistanceToHits(prism, At(prism, truth), truth), 1e-9);
  }
  EXPECT_GT(checked, 15000);
}

TEST(NormalField, FindsProjectionsOnVerticesEdgesAndFolds) {
  RandomPrisms random(6);
  for (int i = 0; i < 5000; ++i) {
    const OffsetPrism prism = random.Prism(0.4);
    NormalHit truth{random.Lambda(), random.Uniform(-2.0, 0.0)};
    truth.lambda[i % 3] = 0.0;
    if (i % 2) truth.lambda[(i + 1) % 3] = 0.0;
    truth.lambda /= truth.lambda.sum();
    if (std::abs(prism.Jacobian(truth).determinant()) < 1e-3) continue;
    EXPECT_LT(DistanceToHits(prism, At(prism, truth), truth), 1e-9);
  }
  // On a fold the root is double, so s is known to √ε only.
  int folds = 0;
  for (int i = 0; i < 5000; ++i) {
    const OffsetPrism prism = random.Prism(0.4);
    NormalHit low{random.Lambda(), -2.0}, high{low.lambda, 0.0};
    const double det = prism.Jacobian(low).determinant();
    if (det * prism.Jacobian(high).determinant() >= 0.0) continue;
    for (int k = 0; k < 60; ++k) {
      NormalHit middle{low.lambda, 0.5 * (low.s + high.s)};
      (prism.Jacobian(middle).determinant() * det > 0.0 ? low : high) = middle;
    }
    const double distance = DistanceToHits(prism, At(prism, low), low);
    // The fold may be missed by rounding: then there is no hit near.
    folds += distance < 1e-4;
  }
  EXPECT_GT(folds, 500);
}

TEST(NormalField, FindsAllThatNewtonFindsFromManyStarts) {
  RandomPrisms random(7);
  int found = 0, several = 0;
  for (int i = 0; i < 2000; ++i) {
    const OffsetPrism prism = random.Prism(0.6);
    const Vector3d x = At(prism, {random.Lambda(), random.Uniform(-2, 1)});
    std::array<NormalHit, 3> hits;
    several += prism.Project(x, -3.0, 3.0, &hits) > 1;
    for (int start = 0; start < 60; ++start) {
      NormalHit hit{random.Lambda(), random.Uniform(-3.0, 3.0)};
      for (int k = 0; k < 60; ++k) {
        const Vector3d step =
            prism.Jacobian(hit).fullPivLu().solve(x - At(prism, hit));
        hit.lambda += Vector3d(-step[0] - step[1], step[0], step[1]);
        hit.s += step[2];
      }
      const double det = prism.Jacobian(hit).determinant();
      const bool converged = (x - At(prism, hit)).norm() < 1e-13;
      if (!converged || hit.lambda.minCoeff() < 0.0 || std::abs(hit.s) > 3.0 ||
          std::abs(det) < 1e-3) {
        continue;
      }
      ++found;
      EXPECT_LT(DistanceToHits(prism, x, hit), 1e-8);
    }
  }
  EXPECT_GT(found, 10000);
  EXPECT_GT(several, 20);
}

// Narrow saves work only: every hit there is lies in what it leaves.  Triangles
// of any shape, needles to an aspect of 1e8 among them.
TEST(NormalField, NarrowingLosesNoProjection) {
  RandomPrisms random(11);
  int hits_seen = 0, refused = 0, tight = 0;
  for (int i = 0; i < 40000; ++i) {
    const Vector3d corner = random.Point(), axis = random.Point().normalized();
    const double size = std::pow(10.0, random.Uniform(-6.0, 0.0));
    const double thin =
        i % 4 == 0 ? std::pow(10.0, random.Uniform(-8.0, 0.0)) : 1.0;
    const Vector3d along = size * random.Point();
    const std::array<Vector3d, 3> corners = {
        corner, corner + along,
        corner + random.Uniform(0, 1) * along + thin * size * random.Point()};
    const double spread = i % 2 ? 0.5 : 0.02;
    const OffsetPrism prism(corners,
                            {(axis + spread * random.Point()).normalized(),
                             (axis + spread * random.Point()).normalized(),
                             (axis + spread * random.Point()).normalized()});
    NormalHit truth{random.Lambda(), random.Uniform(-2.0, 0.0)};
    if (i % 3 == 0) truth.lambda[i % 5 % 3] = 0.0;
    if (i % 7 == 0) truth.s *= 1e-12;
    truth.lambda /= truth.lambda.sum();
    const Vector3d x = i % 5 ? At(prism, truth) : random.Point();
    std::array<NormalHit, 3> hits;
    const int count = prism.Project(x, -2.5, 1e-13, &hits);
    double s_min = -2.5, s_max = 1e-13;
    const bool may_hold = prism.Narrow(x, &s_min, &s_max);
    refused += may_hold ? 0 : 1;
    tight += may_hold && s_max - s_min < 0.5 ? 1 : 0;
    for (int k = 0; k < count; ++k) {
      ++hits_seen;
      ASSERT_TRUE(may_hold);
      EXPECT_GE(hits[k].s, s_min);
      EXPECT_LE(hits[k].s, s_max);
    }
  }
  EXPECT_GT(hits_seen, 20000);
  EXPECT_GT(refused, 2000);
  EXPECT_GT(tight, 10000);
}

TEST(NormalField, IsLinearWhenAllNormalsAgree) {
  RandomPrisms random(8);
  for (int i = 0; i < 1000; ++i) {
    const OffsetPrism prism = random.Prism(0.0);
    const NormalHit truth{random.Lambda(), random.Uniform(-2.0, 2.0)};
    if (std::abs(prism.n0_n) < 1e-3) continue;
    EXPECT_LT(DistanceToHits(prism, At(prism, truth), truth), 1e-11);
  }
}

TEST(NormalField, FindsTheCommonCentreOfACollapsedTriangle) {
  const std::array<Vector3d, 3> corners = {Vector3d::UnitX(), Vector3d::UnitY(),
                                           Vector3d::UnitZ()};
  const OffsetPrism prism(corners, corners);  // a ball's: all meet at s = −1
  std::array<NormalHit, 3> hits;
  ASSERT_GE(prism.Project(Vector3d::Zero(), -2.0, 0.0, &hits), 1);
  EXPECT_NEAR(hits[0].s, -1.0, 1e-5);
  EXPECT_GE(hits[0].lambda.minCoeff(), 0.0);
  EXPECT_NEAR(hits[0].lambda.sum(), 1.0, 1e-15);
}

TEST(NormalField, GradientIsTheDerivativeOfTheDepth) {
  RandomPrisms random(9);
  constexpr double kStep = 1e-5;
  int checked = 0;
  for (int i = 0; i < 5000; ++i) {
    const OffsetPrism prism = random.Prism(0.3);
    const NormalHit hit{random.Lambda(), random.Uniform(-0.5, 0.5)};
    const double least = prism.Jacobian(hit).jacobiSvd().singularValues()[2];
    if (least < 0.1) continue;
    ++checked;
    const Vector3d x = At(prism, hit);
    Vector3d numeric;
    for (int axis = 0; axis < 3; ++axis) {
      double depth[2];
      for (int side = 0; side < 2; ++side) {
        NormalHit moved = hit;
        const Vector3d step = Vector3d::Unit(axis) * (side ? kStep : -kStep);
        ASSERT_TRUE(RefineHit(prism, x + step, 20, &moved));
        depth[side] = prism.SignedDepth(moved);
      }
      numeric[axis] = (depth[1] - depth[0]) / (2.0 * kStep);
    }
    EXPECT_LT((numeric - prism.DepthGradient(hit)).norm(), 1e-6);
    // Moving along the normal changes the depth at rate one.
    EXPECT_NEAR(
        prism.DepthGradient(hit).dot(prism.Normal(hit.lambda).normalized()),
        1.0, 1e-12);
  }
  EXPECT_GT(checked, 1000);
}

// With p(λ) = n(λ) all normals meet in the origin: with σ = 1 + s the point is
// x = σ p(λ), its depth |x| (σ − 1)/σ with σ = x·(1, 1, 1), and the gradient
// p̂ + (|p| (1, 1, 1) − p̂)/σ.
TEST(NormalField, GradientBesideAFoldIsTheClosedFormAndOnItTheNormal) {
  const std::array<Vector3d, 3> corners = {Vector3d::UnitX(), Vector3d::UnitY(),
                                           Vector3d::UnitZ()};
  const OffsetPrism prism(corners, corners);
  for (const Vector3d& lambda :
       {Vector3d(0.25, 0.25, 0.5), Vector3d(0.5, 0.5, 0.0),
        Vector3d(1.0, 0.0, 0.0)}) {
    const Vector3d p = prism.Point(lambda), unit = p.normalized();
    EXPECT_LT((prism.DepthGradient({lambda, -1.0}) - unit).norm(), 1e-15);
    for (const double offset : {1e-12, -1e-12, 1e-6, -1e-6, 0.5, -0.5}) {
      const double s = -1.0 + offset, sigma = 1.0 + s;
      const Vector3d truth =
          unit + (Vector3d::Constant(p.norm()) - unit) / sigma;
      EXPECT_LT((prism.DepthGradient({lambda, s}) - truth).norm(),
                1e-14 * truth.norm());
    }
  }
}

// Opposite normals at the ends of an edge cancel in its middle.
TEST(NormalField, GradientIsZeroWhereTheNormalIs) {
  const OffsetPrism prism(
      {Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY()},
      {Vector3d::UnitZ(), -Vector3d::UnitZ(), Vector3d::UnitZ()});
  for (const double s : {0.0, -0.5, -1e-12}) {
    EXPECT_EQ(prism.DepthGradient({{0.5, 0.5, 0.0}, s}), Vector3d::Zero());
    EXPECT_TRUE(
        prism.DepthGradient({{0.5 + 1e-12, 0.5 - 1e-12, 0.0}, s}).allFinite());
  }
}

}  // namespace
}  // namespace phongpd
