// SPDX-License-Identifier: GPL-3.0-or-later
// Truth by other routes: closed forms of boxes, the scan of all triangles,
// central differences, and the exact inside test a step off the contact.
#include "problems/studies/study_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/bvh/closest_on_triangle.h"
#include "core/mesh/mesh_error.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/smoothed_metric.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "problems/studies/control_metrics.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

ContactSpace TurnedU() {
  return TakeAsContactSpace(Rotated(MakeU(1.0, 0.2, 0.6), GenericRotation()));
}

std::vector<Vector3d> InteriorPoints(const ContactSpace& space, int count) {
  std::mt19937_64 random(7);
  std::vector<Vector3d> points;
  while (static_cast<int>(points.size()) < count) {
    const Vector3d q = RandomPoint(space.bounds(), &random);
    if (space.bvh().Locate(q) == Location::kInside) points.push_back(q);
  }
  return points;
}

PhongMetricOptions Smoothed(double ell) {
  PhongMetricOptions options;
  options.field_options.smoothing_length = ell;
  return options;
}

double DistanceTo(const TriangleMesh& mesh, const Triangle& t,
                  const Vector3d& q) {
  return std::sqrt(ClosestOnTriangle(mesh.vertices[t[0]], mesh.vertices[t[1]],
                                     mesh.vertices[t[2]], q)
                       .squared_distance);
}

// Every face of a box is a local minimum for all of its inside.
TEST(FollowedMetric, KeepsItsFaceOfABox) {
  const auto followed = MakeFollowedMetric(TakeAsContactSpace(
      Rotated(MakeBox({-1, -1, -1}, {1, 1, 1}), GenericRotation())));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> step(-0.2, 0.2);
  Vector3d q(0.9, 0.1, 0.2);
  Branch branch = followed->Query(GenericRotation() * q).branch;
  int flips = 0;
  for (int i = 0; i < 2000; ++i) {
    for (double& x : q) x = std::clamp(x + step(random), -0.99, 0.99);
    const PenetrationResult found =
        followed->Query(GenericRotation() * q, branch);
    ASSERT_EQ(found.status, QueryStatus::kOk);
    EXPECT_NEAR(found.signed_distance, q.x() - 1.0, 1e-14);
    EXPECT_LT((found.direction - GenericRotation() * Vector3d::UnitX()).norm(),
              1e-14);
    branch = found.branch;
    flips += q.cwiseAbs().maxCoeff() > q.x();
  }
  EXPECT_GT(flips, 1000);  // where Euclid has another face
}

TEST(FollowedMetric, WithoutABranchIsEuclidBitForBit) {
  const ContactSpace space = TurnedU();
  const auto followed = MakeFollowedMetric(space);
  const EuclideanMetric euclid(space);
  for (const Vector3d& q : InteriorPoints(space, 300)) {
    const PenetrationResult a = followed->Query(q), b = euclid.Query(q);
    EXPECT_EQ(a.signed_distance, b.signed_distance);
    EXPECT_EQ(a.contact, b.contact);
    EXPECT_EQ(a.direction, b.direction);
    EXPECT_TRUE(a.branch.IsValid());
    Branch unknown;
    unknown.triangle = 1 << 20;
    EXPECT_EQ(followed->Query(q, unknown).contact, b.contact);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(followed->Query({nan, 0, 0}).status, QueryStatus::kInvalid);
}

// From any triangle: a foot that no triangle around it undercuts, no farther
// than where the descent began, and told right from feet seen from behind.
TEST(FollowedMetric, StandsInALocalMinimumOfItsSheet) {
  const ContactSpace space = TurnedU();
  const TriangleMesh& mesh = space.mesh();
  const auto followed = MakeFollowedMetric(space);
  const EuclideanMetric euclid(space);
  int kept = 0, ended = 0, corners = 0;
  for (const Vector3d& q : InteriorPoints(space, 200)) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Branch branch;
      branch.triangle = static_cast<int>(t);
      branch.lambda = Vector3d::Constant(1.0 / 3.0);
      const PenetrationResult found = followed->Query(q, branch);
      ASSERT_TRUE(found.inside);
      if (found.status == QueryStatus::kBranchEnded) {
        ++ended;
        EXPECT_EQ(found.contact, euclid.Query(q).contact);
        continue;
      }
      ++kept;
      const double depth = -found.signed_distance;
      EXPECT_LE(depth, DistanceTo(mesh, mesh.triangles[t], q) + 1e-14);
      int around = 0;
      for (const Triangle& other : mesh.triangles) {
        if (DistanceTo(mesh, other, found.contact) > 1e-13) continue;
        ++around;
        EXPECT_GE(DistanceTo(mesh, other, q), depth - 1e-13);
      }
      corners += around > 1;
      const Vector3d off = found.contact + 1e-6 * (q - found.contact);
      EXPECT_EQ(space.bvh().Locate(off), Location::kInside);
    }
  }
  EXPECT_GT(kept, 1000);
  EXPECT_GT(ended, 100);
  EXPECT_GT(corners, 100);
}

TEST(FollowedMetric, GradientIsTheDerivativeAlongItsBranch) {
  const ContactSpace space = TurnedU();
  const auto followed = MakeFollowedMetric(space);
  const double h = 1e-6;
  int compared = 0, off = 0;
  for (const Vector3d& q : InteriorPoints(space, 100)) {
    for (int t = 0; t < static_cast<int>(space.mesh().triangles.size()); ++t) {
      const PenetrationResult found =
          followed->Query(q, {t, Vector3d::Constant(1.0 / 3.0), -1.0});
      Vector3d difference;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d step = h * Vector3d::Unit(axis);
        difference[axis] =
            (followed->Query(q + step, found.branch).signed_distance -
             followed->Query(q - step, found.branch).signed_distance) /
            (2.0 * h);
      }
      ++compared;
      off += (difference - found.gradient).norm() > 1e-6;
      EXPECT_NEAR(found.direction.norm(), 1.0, 1e-14);
    }
  }
  EXPECT_GT(compared, 2000);
  EXPECT_LE(off, compared / 500);  // a kink within the step
}

TEST(FollowedMetric, TellsWhereItsBranchEnds) {
  const ContactSpace space = TakeAsContactSpace(Joined(
      MakeBox({-1, -1, -1}, {1, 1, 1}), MakeBox({1.5, -1, -1}, {3.5, 1, 1})));
  const auto followed = MakeFollowedMetric(space);
  const Branch branch = followed->Query({0.9, 0.0, 0.1}).branch;
  EXPECT_EQ(followed->Query({1.2, 0.0, 0.1}, branch).status, QueryStatus::kOk);
  EXPECT_EQ(followed->Query({-1.2, 0.0, 0.1}, branch).status,
            QueryStatus::kBranchEnded);
  const PenetrationResult other = followed->Query({1.6, 0.0, 0.1}, branch);
  EXPECT_EQ(other.status, QueryStatus::kBranchEnded);
  EXPECT_NEAR(other.signed_distance, -0.1, 1e-15);
}

TEST(MixedMetric, HasEuclidsValueAndPhongsDirection) {
  const ContactSpace space = TurnedU();
  const auto mixed = MakeMixedMetric(space, Smoothed(0.2));
  const EuclideanMetric euclid(space);
  const PhongMetric phong(space, Smoothed(0.2));
  int apart = 0;
  Branch branch;
  for (const Vector3d& q : InteriorPoints(space, 500)) {
    const PenetrationResult m = mixed->Query(q, branch);
    const PenetrationResult e = euclid.Query(q), p = phong.Query(q, branch);
    EXPECT_EQ(m.signed_distance, e.signed_distance);
    EXPECT_EQ(m.contact, e.contact);
    EXPECT_EQ(m.triangle, e.triangle);
    EXPECT_EQ(m.direction, p.direction);
    EXPECT_EQ(m.gradient, p.gradient);
    EXPECT_EQ(m.status, p.status);
    EXPECT_EQ(m.branch.triangle, p.branch.triangle);
    apart += p.signed_distance < 1.1 * e.signed_distance;
    branch = p.branch;
  }
  EXPECT_GT(apart, 50);
  const Vector3d outside = space.bounds().max + Vector3d::Ones();
  EXPECT_EQ(mixed->Query(outside).direction, euclid.Query(outside).direction);
}

// A slot of width g: w = g/ℓ.  Where nothing is as near as ℓ: Phong's own.
TEST(FadedMetric, FadesByTheFreeWayBeyondTheContact) {
  const double gap = 0.25;
  const ContactSpace space = TakeAsContactSpace(Joined(
      MakeBox({-1, -1, -1}, {1, 1, 1}), MakeBox({1 + gap, -1, -1}, {3, 1, 1})));
  const double ell = 0.2 * space.length();
  ASSERT_GT(ell, gap);
  const auto faded = MakeFadedMetric(space, Smoothed(0.2));
  const PhongMetric phong(space, Smoothed(0.2));
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> side(-0.6, 0.6), depth(0.05, 0.3);
  const double w = gap / ell;
  double farthest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d across(0.0, side(random), side(random));
    const Vector3d at_slot = Vector3d(1.0 - depth(random), 0, 0) + across;
    const PenetrationResult p = phong.Query(at_slot);
    const PenetrationResult f = faded->Query(at_slot, {});
    const Vector3d blend = w * p.direction + (1.0 - w) * Vector3d::UnitX();
    EXPECT_LT((f.direction - blend.normalized()).norm(), 1e-12);
    EXPECT_EQ(f.gradient, f.direction);
    EXPECT_NEAR(f.signed_distance, at_slot.x() - 1.0, 1e-15);
    farthest = std::max(farthest, (f.direction - p.direction).norm());
    const Vector3d at_back = Vector3d(-1.0 + depth(random), 0, 0) + across;
    EXPECT_LT(
        (faded->Query(at_back, {}).direction - phong.Query(at_back).direction)
            .norm(),
        1e-15);
  }
  EXPECT_GT(farthest, 0.1);
}

TEST(ParseStudyMetric, KnowsItsNamesAndRefusesOthers) {
  const StudyMetric followed = ParseStudyMetric("followed", "--metrics");
  EXPECT_EQ(followed.own->kind, "followed");
  EXPECT_EQ(followed.penetration.metric, MetricKind::kEuclidean);
  const StudyMetric mixed = ParseStudyMetric("mixed@0.1", "--metrics");
  EXPECT_EQ(mixed.Name(), "mixed@0.1");
  EXPECT_EQ(mixed.own->kind, "mixed");
  EXPECT_EQ(mixed.penetration.smoothing_length.Text(), "0.1");
  EXPECT_EQ(ParseStudyMetric("faded@0.2", "--metrics").own->kind, "faded");
  EXPECT_FALSE(ParseStudyMetric("phong@0.2", "--metrics").own);
  for (const char* text : {"followed@0.1", "mixed", "mixed@x", "faded@-1"}) {
    EXPECT_THROW(ParseStudyMetric(text, "--metrics"), InputError) << text;
  }
}

// The direction alone is another: value and contact are Euclid's, bit for bit.
TEST(ControlMetrics, DifferFromEuclidByTheirDirectionAlone) {
  const ContactSpace space = TurnedU();
  const EuclideanMetric euclid(space);
  const SmoothedMetric smoothed(space);
  const auto placebo = MakePlaceboMetric(space, 0.2);
  const auto diffused = MakeDiffusedMetric(space, 0.2);
  Vector3d to_sides = Vector3d::Zero();
  int turned = 0;
  for (const Vector3d& q : InteriorPoints(space, 300)) {
    const PenetrationResult e = euclid.Query(q);
    for (const auto& metric : {placebo, diffused}) {
      const PenetrationResult found = metric->Query(q);
      EXPECT_EQ(found.signed_distance, e.signed_distance);
      EXPECT_EQ(found.contact, e.contact);
      EXPECT_NEAR(found.direction.norm(), 1.0, 1e-12);
      EXPECT_EQ(found.direction, found.gradient);
      EXPECT_EQ(metric->Query(q).direction, found.direction);
    }
    const double angle = std::acos(
        std::clamp(smoothed.Query(q).direction.dot(e.direction), -1.0, 1.0));
    const Vector3d lot = placebo->Query(q).direction;
    EXPECT_NEAR(std::acos(std::clamp(lot.dot(e.direction), -1.0, 1.0)), angle,
                1e-6);
    to_sides += lot - lot.dot(e.direction) * e.direction;
    turned += angle > 0.05 ? 1 : 0;
  }
  EXPECT_GT(turned, 100);
  // By lot: the sides cancel.
  EXPECT_LT(to_sides.norm() / 300.0, 0.1);
  const Vector3d outside = 2.0 * space.bounds().max;
  EXPECT_EQ(placebo->Query(outside).signed_distance,
            euclid.Query(outside).signed_distance);
}

// Of a ball every normal leads from its centre, diffused or not.
TEST(ControlMetrics, DiffusedLeadsOutOfABallAsEuclidDoes) {
  const ContactSpace ball = TakeAsContactSpace(MakeIcoBall(1.0, 4));
  const auto diffused = MakeDiffusedMetric(ball, 0.2);
  for (const Vector3d& q : InteriorPoints(ball, 100)) {
    if (q.norm() < 0.2) continue;
    EXPECT_GT(diffused->Query(q).direction.dot(q.normalized()), 0.99);
  }
}

}  // namespace
}  // namespace phongpd
