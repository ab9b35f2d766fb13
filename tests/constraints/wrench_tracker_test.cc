// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the stated bound by closed forms of the robot's gyration, depths by
// windows of DepthQuery, levers by an integral of one variable.
#include "constraints/wrench_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "constraints/gap_lever.h"
#include "core/mesh/mesh_error.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/random_vector.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;

const Vector3d kHalf(0.6, 0.2, 0.15);  // of the bar

Solid TurningBar() { return MakeSolid(MakeBox(-kHalf, kHalf), "bar"); }
Solid Floor() { return MakeSolid(MakeBox({-9, -9, -1}, {9, 9, 0}), "slab"); }

// √(∫ |p|² dA / ∫ dA) of the bar: two faces each way, x and y over a face of
// half-widths a, b at height c have the mean a²/3 + b²/3 + c².
double BarGyration() {
  double sum = 0.0, areas = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double a = kHalf[(k + 1) % 3], b = kHalf[(k + 2) % 3], c = kHalf[k];
    sum += a * b * (a * a / 3 + b * b / 3 + c * c);
    areas += a * b;
  }
  return std::sqrt(sum / areas);
}

double Angle(const Vector3d& a, const Vector3d& b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * (a - b).norm()));
}

TEST(WrenchTracker, MeasuresStepsByTheGyrationOfTheSurface) {
  const WrenchTracker tracker(TurningBar(), Floor());
  EXPECT_NEAR(tracker.gyration(), BarGyration(), 1e-14);
  const RobotPose a = {{0, 0, 1}, Quaterniond::Identity()};
  const RobotPose b = {
      {3, 0, 1},
      Quaterniond(AngleAxisd(4.0 / BarGyration() / 4.0, Vector3d::UnitY()))};
  EXPECT_NEAR(tracker.StepLength(a, b), std::hypot(3.0, 1.0), 1e-12);
}

// Walks with steps from 1e-4 to the robot's own size.
TEST(WrenchTracker, KeepsItsBoundHoweverTheRobotMoves) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const TriangleMesh obstacles[] = {MakeL(2.0, 0.5, 0.6),
                                    MakePlateWithHole(2.4, 0.3, 0.8)};
  int steps = 0, bounded = 0;
  for (const double speed : {0.5, 2.0}) {
    for (const TriangleMesh& obstacle : obstacles) {
      const WrenchTracker tracker(TurningBar(), MakeSolid(obstacle, "obstacle"),
                                  speed);
      const Vector3d center = ComputeBounds(obstacle).Center();
      WrenchTracker::State state;
      RobotPose pose = {obstacle.vertices[0], Quaterniond::Identity()};
      for (int i = 0; i < 60; ++i) {
        const WrenchTracker::State before = state;
        const double size = std::pow(10.0, -4.0 + 4.0 * (i % 7) / 6.0);
        const Vector3d turn = size * RandomVector(&normal, &random);
        pose.position += 0.3 * size * RandomVector(&normal, &random) +
                         0.05 * (center - pose.position);
        pose.orientation =
            AngleAxisd(turn.norm(), turn.normalized()) * pose.orientation;
        pose.orientation.normalize();
        const TrackedWrench wrench = tracker.Step(pose, &state);
        if (wrench.status != DepthStatus::kPenetrating) {
          EXPECT_FALSE(state.has_begun);
          continue;
        }
        EXPECT_NEAR(wrench.normal.norm(), 1.0, 1e-14);
        EXPECT_GE(wrench.exit, wrench.euclidean_depth * (1.0 - 1e-12));
        EXPECT_TRUE(
            ((pose.orientation.inverse() * wrench.lever).cwiseAbs() - kHalf)
                .maxCoeff() <= 1e-12)
            << "the lever is outside of the robot";
        if (!before.has_begun) continue;
        const double step = std::hypot(
            (pose.position - before.pose.position).norm(),
            BarGyration() *
                AngleAxisd(pose.orientation * before.pose.orientation.inverse())
                    .angle());
        ++steps;
        bounded += wrench.turned < 0.499 * wrench.wanted ? 1 : 0;
        EXPECT_LE(Angle(before.normal, wrench.normal),
                  speed * step / BarGyration() + 1e-7);
        EXPECT_LE((state.lever - before.lever).norm(), speed * step + 1e-12);
        EXPECT_LE(std::abs(wrench.push - before.push), speed * step + 1e-12);
      }
    }
  }
  EXPECT_GT(steps, 100);
  EXPECT_GT(bounded, 5) << "nothing that needs a bound";
}

TEST(WrenchTracker, FreesByItsWayOutAndNoSooner) {
  const Solid bar = TurningBar(), trap = MakeSolid(MakeU(2.0, 0.4, 0.8), "U");
  const WrenchTracker tracker(bar, trap);
  const DepthQuery query(bar, trap);
  WrenchTracker::State state;
  for (int i = 0; i <= 12; ++i) {
    const RobotPose pose = {
        {0.3 + 0.1 * i, 0.25, 0.4},
        Quaterniond(AngleAxisd(0.1 * i, Vector3d(1, 2, 3).normalized()))};
    const ContactSpace space = tracker.SpaceAt(pose.orientation);
    for (const TrackedWrench& wrench :
         {tracker.Step(space, pose, &state), tracker.SmoothedAt(space, pose)}) {
      ASSERT_EQ(wrench.status, DepthStatus::kPenetrating);
      RobotPose moved = pose;
      moved.position += wrench.exit * wrench.normal;
      EXPECT_NEAR(query.At(moved).SignedDistance(), 0.0, 1e-9);
      EXPECT_NEAR(query.At(pose).depth, wrench.euclidean_depth, 1e-9);
      for (const double share : {0.1, 0.5, 0.99}) {
        moved.position = pose.position + share * wrench.exit * wrench.normal;
        EXPECT_EQ(query.At(moved).status, DepthStatus::kPenetrating);
      }
    }
  }
}

// A bar beside the middle of a box: Euclid's direction goes from one of its
// faces to the other as it passes the level, the smoothed one by way of
// between.
TEST(WrenchTracker, SmoothedChangesLessTheLessTheStep) {
  const Solid bar = TurningBar();
  const Solid box = MakeSolid(MakeBox({-3, -2, -0.5}, {3, 2, 0.5}), "plate");
  const WrenchTracker tracker(bar, box);
  double before = 0.0;
  for (const int steps : {12, 24, 48}) {
    double change = 0.0, torque_change = 0.0, euclid_change = 0.0;
    TrackedWrench last;
    Vector3d last_direction = Vector3d::Zero();
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const RobotPose pose = {
          {2.5, 0.0, 0.2 * t - 0.1},
          Quaterniond(AngleAxisd(0.7 * t - 0.3, Vector3d::UnitY()))};
      const ContactSpace space = tracker.SpaceAt(pose.orientation);
      const TrackedWrench wrench = tracker.SmoothedAt(space, pose);
      ASSERT_FALSE(wrench.is_fallback);
      const Vector3d direction = PenetrationDepth(bar, box, pose).direction;
      if (i > 0) {
        change = std::max(change, (wrench.normal - last.normal).norm());
        torque_change =
            std::max(torque_change, (wrench.Torque() - last.Torque()).norm());
        euclid_change =
            std::max(euclid_change, (direction - last_direction).norm());
      }
      last = wrench;
      last_direction = direction;
    }
    EXPECT_GT(euclid_change, 1.4);
    const double both = std::max(change, torque_change);
    EXPECT_LT(both, 0.3);
    if (before > 0.0) {
      EXPECT_LT(both, 0.6 * before);
    }
    before = both;
  }
}

// Why no tracker bounds the way out: a peg in a tight hole is free; turned by a
// thousandth it has to go out until what is left in the hole, 0.2, fits.
TEST(WrenchTracker, CannotBoundDepthsThatJumpThemselves) {
  const Solid peg =
      MakeSolid(MakeBox({-0.1, -0.1, -0.4}, {0.1, 0.1, 0.4}), "peg");
  const Solid plate = MakeSolid(MakePlateWithHole(2.0, 0.6, 0.2002), "plate");
  RobotPose pose;
  EXPECT_NEAR(PenetrationDepth(peg, plate, pose).clearance, 1e-4, 1e-9);
  pose.orientation = AngleAxisd(1e-3, Vector3d::UnitX());
  WrenchTracker::State state;
  const TrackedWrench wrench = WrenchTracker(peg, plate).Step(pose, &state);
  EXPECT_NEAR(wrench.euclidean_depth, 0.5, 1e-3);
}

TEST(WrenchTracker, BeginsAnewOutsideAndKeepsItsStateThroughNonsense) {
  const WrenchTracker tracker(TurningBar(), Floor());
  WrenchTracker::State state;
  const RobotPose inside = {{0, 0, 0.1}, Quaterniond::Identity()};
  const TrackedWrench first = tracker.Step(inside, &state);
  EXPECT_NEAR(first.normal.z(), 1.0, 1e-12);
  EXPECT_NEAR(first.exit, 0.05, 1e-12);
  EXPECT_NEAR(first.push, 0.05, 1e-12);
  EXPECT_NEAR(first.lever.x(), 0.0, 1e-9);
  EXPECT_TRUE(state.has_begun);
  const ContactSpace space = tracker.SpaceAt(inside.orientation);
  RobotPose nonsense = inside;
  nonsense.position.x() = NAN;
  EXPECT_EQ(tracker.Step(space, nonsense, &state).status,
            DepthStatus::kInvalid);
  nonsense = inside;
  nonsense.orientation.w() = INFINITY;
  EXPECT_EQ(tracker.Step(space, nonsense, &state).status,
            DepthStatus::kInvalid);
  EXPECT_EQ(tracker.SmoothedAt(space, nonsense).status, DepthStatus::kInvalid);
  EXPECT_THROW(tracker.Step(nonsense, &state), InputError);
  EXPECT_TRUE(state.has_begun);
  RobotPose outside = inside;
  outside.position.z() = 0.15;
  EXPECT_EQ(tracker.Step(space, outside, &state).status,
            DepthStatus::kTouching);
  outside.position.z() = 0.2;
  const TrackedWrench free = tracker.Step(space, outside, &state);
  EXPECT_EQ(free.status, DepthStatus::kSeparate);
  EXPECT_EQ(free.normal, Vector3d::Zero());
  EXPECT_EQ(free.exit, 0.0);
  EXPECT_FALSE(state.has_begun);
}

TEST(WrenchTracker, RefusesSpeedsAndSolidsThatAreNone) {
  for (const double speed : {0.0, -1.0, double{NAN}, double{INFINITY}}) {
    EXPECT_THROW(WrenchTracker(TurningBar(), Floor(), speed), InputError);
  }
  EXPECT_THROW(WrenchTracker(Solid(), Floor()), InputError);
  EXPECT_THROW(WrenchTracker(TurningBar(), Solid()), InputError);
}

// A cube of side 2 above a slab by g: its lower face weighs κ(g/δ), its four
// sides κ((g + y)/δ) at the height y over that.
TEST(GapLever, IsTheMeanByItsIntegral) {
  const double reach = 0.25, g = 0.1;
  const GapLever lever(MakeBox({-1, -1, -1}, {1, 1, 1}), Floor().mesh(), reach);
  const auto weight = [&](double gap) {
    return std::pow(1.0 - std::min(1.0, gap * gap / reach / reach), 4.0);
  };
  double sum = -4.0 * weight(g), weights = 4.0 * weight(g);
  const int parts = 20000;
  for (int i = 0; i < parts; ++i) {
    const double y = 2.0 * (i + 0.5) / parts, area = 8.0 * 2.0 / parts;
    weights += area * weight(g + y);
    sum += area * weight(g + y) * (y - 1.0);
  }
  Vector3d mean;
  ASSERT_TRUE(lever.At({{5, 3, 1 + g}, Quaterniond::Identity()}, &mean));
  EXPECT_NEAR(mean.z(), sum / weights, 0.01);
  EXPECT_NEAR(mean.x(), 0.0, 0.01);
  EXPECT_FALSE(lever.At({{0, 0, 1 + reach}, Quaterniond::Identity()}, &mean));
}

// The contact point goes from end to end as the bar passes the parallel; the
// mean does not.
TEST(GapLever, PassesTheParallelWithoutAJump) {
  const GapLever lever(TurningBar().mesh(), Floor().mesh(), 0.15);
  Vector3d left, right;
  for (const double angle : {1e-3, 1e-6}) {
    const auto at = [&](double a, Vector3d* mean) {
      const double height =
          kHalf.x() * std::sin(std::abs(a)) + kHalf.z() * std::cos(a);
      return lever.At(
          {{0, 0, height}, Quaterniond(AngleAxisd(a, Vector3d::UnitY()))},
          mean);
    };
    ASSERT_TRUE(at(angle, &left));
    ASSERT_TRUE(at(-angle, &right));
    EXPECT_LT((left - right).norm(), 20.0 * angle);
  }
  EXPECT_THROW(GapLever(TurningBar().mesh(), Floor().mesh(), 0.0), InputError);
  EXPECT_THROW(GapLever(TurningBar().mesh(), Floor().mesh(), 1e-5), InputError);
}

}  // namespace
}  // namespace phongpd
