// SPDX-License-Identifier: GPL-3.0-or-later
// The promises of penetration_tracker.h but for its bounds
// (penetration_tracker_campaign_test): what it follows, statuses, states.
#include "core/projection/penetration_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/bvh/closest_on_triangle.h"
#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"
#include "tests/support/tracked_motions.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Motion;
using State = PenetrationTracker::State;

TriangleMesh Cube() {
  return MakeBox(Vector3d::Constant(-0.2), Vector3d::Constant(0.2));
}

// A quarter of the steps, at the same places: the curve is that of the motion,
// but for when a search happens to be due and what one step more resolves.
TEST(PenetrationTracker, ShorterStepsGiveTheSameCurve) {
  long frames = 0, apart = 0;
  double mean = 0.0;
  for (const testing::TrackedSpace& space : testing::TrackedSpaces(5)) {
    const PenetrationTracker tracker(space.contact);
    std::mt19937_64 random(7);
    for (int m = 0; m < 20; ++m) {
      const Motion fine =
          testing::MakeMotion(space.contact, m % 2, 1201, &random);
      State of_fine, of_coarse;
      for (std::size_t i = 0; i < fine.size(); ++i) {
        const Vector3d pd = tracker.Step(fine[i], &of_fine).pd;
        if (i % 4 != 0) continue;
        const double difference =
            (tracker.Step(fine[i], &of_coarse).pd - pd).norm() /
            space.contact.length();
        ++frames;
        mean += difference;
        apart += difference > 0.02 ? 1 : 0;
      }
    }
  }
  EXPECT_LT(static_cast<double>(apart), 0.005 * static_cast<double>(frames));
  EXPECT_LT(mean, 1e-3 * static_cast<double>(frames));
}

// Distance of q to the piece of {x : |x − q| ≤ radius} that meets `triangle`,
// by spreading over edges that come as near.
double DistanceToPiece(const TriangleMesh& mesh,
                       const std::vector<std::array<int, 3>>& neighbors,
                       int triangle, const Vector3d& q, double radius) {
  std::vector<char> seen(mesh.triangles.size(), 0);
  std::vector<int> open{triangle};
  seen[triangle] = 1;
  double least = std::numeric_limits<double>::infinity();
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    const Triangle& t = mesh.triangles[at];
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                   &c = mesh.vertices[t[2]];
    least = std::min(least, ClosestOnTriangle(a, b, c, q).squared_distance);
    for (int k = 0; k < 3; ++k) {
      const int next = neighbors[at][k];
      const Vector3d &from = mesh.vertices[t[k]],
                     &to = mesh.vertices[t[(k + 1) % 3]];
      const Vector3d e = to - from;
      const double along =
          std::clamp((q - from).dot(e) / e.squaredNorm(), 0.0, 1.0);
      if (seen[next] != 0 || (from + along * e - q).norm() > radius) continue;
      seen[next] = 1;
      open.push_back(next);
    }
  }
  return std::sqrt(least);
}

// What "following" says, but for how long a search is believed: q may move by
// 3 % of d until a place that has come within reach is noticed.
TEST(PenetrationTracker, FollowsTheClosestPointOfItsPiece) {
  long following = 0, late = 0, elsewhere = 0;
  for (const testing::TrackedSpace& space : testing::TrackedSpaces(8)) {
    const PenetrationTracker tracker(space.contact);
    const TriangleMesh& mesh = space.contact.mesh();
    const auto neighbors = TriangleNeighbors(mesh);
    std::mt19937_64 random(9);
    for (int m = 0; m < 6; ++m) {
      State state;
      for (const Vector3d& q :
           testing::MakeMotion(space.contact, m % 2, 200, &random)) {
        const TrackerResult now = tracker.Step(q, &state);
        const double reach = 3.0 * now.euclidean_depth;
        if (now.status != QueryStatus::kFollowing || now.magnitude > reach) {
          continue;
        }
        const double least =
            DistanceToPiece(mesh, neighbors, now.triangle, q, reach);
        ++following;
        late += now.magnitude > least * (1.0 + 1e-9) ? 1 : 0;
        elsewhere += least > now.euclidean_depth * (1.0 + 1e-9) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(following, 6000);
  // Euclid's own point is not always in the piece: else this says nothing.
  EXPECT_GT(elsewhere, 100);
  EXPECT_LT(static_cast<double>(late), 0.01 * static_cast<double>(following))
      << late;
}

TEST(PenetrationTracker, ScalesBitForBitWithTheInput) {
  const TriangleMesh mesh =
      BuildContactSpace(MakeIcoBall(0.25, 1), MakeU(2.0, 0.3, 0.6)).mesh();
  const ContactSpace contact = TakeAsContactSpace(mesh);
  const PenetrationTracker tracker(contact);
  std::mt19937_64 random(6);
  const Motion motion = testing::MakeMotion(contact, 1, 400, &random);
  for (const double factor : {0x1p200, 0x1p-200}) {
    const PenetrationTracker scaled(TakeAsContactSpace(Scaled(mesh, factor)));
    State one, other;
    for (const Vector3d& q : motion) {
      const TrackerResult a = tracker.Step(q, &one);
      const TrackerResult b = scaled.Step(factor * q, &other);
      ASSERT_EQ(a.status, b.status);
      ASSERT_EQ(a.pd * factor, b.pd);
      ASSERT_EQ(a.ratio, b.ratio);
    }
  }
}

// Of 4 × 4 × 1; pushed from above, the contact is on top at z = 0.5.
ContactSpace Plate() {
  return TakeAsContactSpace(MakeBox({-2, -2, -0.5}, {2, 2, 0.5}));
}

TEST(PenetrationTracker, LeavingElsewhereIsZeroAtOnceAndCounted) {
  const PenetrationTracker tracker(Plate());
  State state;
  int elsewhere = 0, sliding = 0;
  TrackerResult before;
  for (int i = 0; i <= 160; ++i) {
    const TrackerResult now =
        tracker.Step({0.1, 0.2, 0.6 - 0.0075 * i}, &state);
    if (now.status == QueryStatus::kLeftElsewhere) {
      ++elsewhere;
      EXPECT_GT(before.magnitude, 11.0 * 0.0075);
      EXPECT_EQ(now.pd, Vector3d::Zero());
    }
    sliding += now.status == QueryStatus::kSliding ? 1 : 0;
    // Twice as deep as nearest is within three times: no reason to move.
    if (now.inside && now.euclidean_depth > 0.26) {
      EXPECT_EQ(now.contact.z(), 0.5);
    }
    before = now;
  }
  EXPECT_EQ(before.status, QueryStatus::kOutside);
  EXPECT_EQ(elsewhere, 1);
  EXPECT_GT(sliding, 10);
  // Back in from below: anew, from there.
  const TrackerResult again = tracker.Step({0.1, 0.2, -0.45}, &state);
  EXPECT_EQ(again.status, QueryStatus::kFollowing);
  EXPECT_NEAR((again.contact - Vector3d(0.1, 0.2, -0.5)).norm(), 0.0, 1e-14);
}

TEST(PenetrationTracker, LeavingAtTheContactIsNoEvent) {
  const PenetrationTracker tracker(Plate());
  State state;
  for (int i = 0; i <= 100; ++i) {
    const double z = 0.6 - 0.3 * std::sin(0.0314159 * i);
    const TrackerResult now = tracker.Step({0.004 * i, 0.2, z}, &state);
    EXPECT_EQ(now.status,
              z < 0.5 ? QueryStatus::kFollowing : QueryStatus::kOutside);
    if (z < 0.5) {
      EXPECT_NEAR(now.magnitude, 0.5 - z, 1e-14);
      EXPECT_NEAR(now.ratio, 1.0, 1e-12);
    }
  }
}

// Slowly over the ridge of an L the contact changes sides around its edge.
TEST(PenetrationTracker, SlidesToTheNearerSideWhereAWayLeadsThere) {
  const PenetrationTracker tracker(TakeAsContactSpace(MakeL(2.0, 1.0, 4.0)));
  State state;
  TrackerResult now;
  for (int i = 0; i <= 400; ++i) {
    now = tracker.Step({0.3 + 0.0005 * i, 0.45 - 0.0005 * i, 2.0}, &state);
    EXPECT_LE(now.ratio, 1.7);
  }
  EXPECT_EQ(now.status, QueryStatus::kFollowing);
  EXPECT_NEAR(now.magnitude, 0.25, 1e-14);
  EXPECT_NEAR(now.contact.y(), 0.0, 1e-14);
}

TEST(PenetrationTracker, StaysOnTheComponentItEnteredThrough) {
  // A shell: the cavity [−1, 1]³ in the cube [−2, 2]³.
  const PenetrationTracker tracker(
      TakeAsContactSpace(MakeVessel(4.0, 2.0, 0.0)));
  State state;
  for (int i = 0; i <= 209; ++i) {
    const double x = 0.95 + 0.005 * i;
    const TrackerResult now = tracker.Step({x, 0.1, 0.2}, &state);
    EXPECT_EQ(now.inside, x > 1.0);
    if (!now.inside) continue;
    EXPECT_EQ(now.status, QueryStatus::kFollowing);
    EXPECT_NEAR((now.contact - Vector3d(1, 0.1, 0.2)).norm(), 0.0, 1e-14);
    EXPECT_NEAR(now.euclidean_depth, std::min(x - 1.0, 2.0 - x), 1e-14);
  }
  EXPECT_EQ(tracker.Step({2.01, 0.1, 0.2}, &state).status,
            QueryStatus::kLeftElsewhere);
}

TEST(PenetrationTracker, WhatIsNotFiniteIsInvalidAndChangesNothing) {
  const PenetrationTracker tracker(Plate());
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  State state, untouched;
  for (int i = 0; i < 50; ++i) {
    const Vector3d q(0.03 * i, 0.01 * i, 0.45 - 0.01 * i);
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      const TrackerResult none = tracker.Step({q.x(), bad, q.z()}, &state);
      EXPECT_EQ(none.status, QueryStatus::kInvalid);
      EXPECT_EQ(none.pd, Vector3d::Zero());
      EXPECT_EQ(none.ratio, 0.0);
    }
    EXPECT_EQ(tracker.Step(q, &state).pd, tracker.Step(q, &untouched).pd);
  }
  const TrackerResult far = tracker.Step({1e300, -1e300, 0.0}, &state);
  EXPECT_EQ(far.status, QueryStatus::kOutside);
}

TEST(PenetrationTracker, ARobotAtRestHasItsContactAtRest) {
  const PenetrationTracker tracker(
      BuildContactSpace(Cube(), MakeU(2.0, 0.3, 0.6)));
  std::mt19937_64 random(3);
  State state;
  for (const Vector3d& q : testing::MakeMotion(
           BuildContactSpace(Cube(), MakeU(2.0, 0.3, 0.6)), 0, 100, &random)) {
    const TrackerResult first = tracker.Step(q, &state);
    for (int i = 0; i < 3; ++i) {
      const TrackerResult again = tracker.Step(q, &state);
      EXPECT_EQ(again.pd, first.pd);
      EXPECT_EQ(again.moved, 0.0);
    }
  }
}

TEST(PenetrationTracker, OptionsOutOfRangeAreRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double ratio : {0.99, -1.0, kNan, kInfinity}) {
    PenetrationTrackerOptions options;
    options.ratio = ratio;
    EXPECT_THROW(PenetrationTracker(Plate(), options), InputError);
  }
  for (const double speed : {0.0, -1.0, kNan, 1e7}) {
    PenetrationTrackerOptions options;
    options.speed = speed;
    EXPECT_THROW(PenetrationTracker(Plate(), options), InputError);
  }
  PenetrationTrackerOptions slow;
  slow.ratio = 1.0;
  slow.speed = 0.5;
  EXPECT_NO_THROW(PenetrationTracker(Plate(), slow));
}

TEST(PenetrationTracker, StatesAreValues) {
  const ContactSpace contact =
      BuildContactSpace(MakeIcoBall(0.25, 1), MakeU(2.0, 0.3, 0.6));
  const PenetrationTracker tracker(contact), copy = tracker;
  std::mt19937_64 random(4);
  const Motion motion = testing::MakeMotion(contact, 1, 600, &random);
  State state;
  std::vector<Vector3d> pd;
  State middle;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (i == 300) middle = state;
    pd.push_back(tracker.Step(motion[i], &state).pd);
  }
  // A copied state goes the same way from there, with a copied tracker too.
  State moved = std::move(middle);
  for (std::size_t i = 300; i < motion.size(); ++i) {
    EXPECT_EQ(copy.Step(motion[i], &moved).pd, pd[i]);
  }
  // Another tracker's state is a new one.
  const PenetrationTracker other(contact);
  const Vector3d q = testing::InnerPoint(contact, &random);
  EXPECT_NEAR(other.Step(q, &state).ratio, 1.0, 1e-12);
}

TEST(PenetrationTracker, ThreadsGetTheSameBits) {
  const ContactSpace contact =
      BuildContactSpace(MakeIcoBall(0.25, 1), MakeL(2.0, 0.5, 0.6));
  const PenetrationTracker tracker(contact);
  std::mt19937_64 random(8);
  const Motion motion = testing::MakeMotion(contact, 2, 2000, &random);
  const auto sum = [&] {
    State state;
    double total = 0.0;
    for (const Vector3d& q : motion) total += tracker.Step(q, &state).magnitude;
    return total;
  };
  const double alone = sum();
  std::vector<double> found(4);
  std::vector<std::thread> threads;
  for (double& value : found) {
    threads.emplace_back([&value, &sum] { value = sum(); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double value : found) EXPECT_EQ(value, alone);
}

}  // namespace
}  // namespace phongpd
