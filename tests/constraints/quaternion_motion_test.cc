// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms of what touches in a moment, poses in CGAL's exact
// kernel; then, for the judge in doubles, rational numbers for each pair of
// triangles.
#include "constraints/rigid/quaternion_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "constraints/rigid/exact_pair.h"
#include "constraints/rigid/rigid_judge.h"
#include "core/bvh/triangle_corners.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/expect_refused.h"
#include "tests/support/rigid_truth.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using internal::ExactPairJudge;
using testing::Cube;
using testing::MeetExactly;
using testing::PoseAt;
using testing::RandomRotation;

QuaternionMotion Between(const RobotPose& start, const RobotPose& end) {
  return QuaternionMotion::Between(start, end);
}

TriangleMesh At(TriangleMesh mesh, const RobotPose& pose) {
  for (Vector3d& v : mesh.vertices) v = pose.orientation * v + pose.position;
  return mesh;
}

// Every pair of triangles on the whole way, no box and no filter between.
bool MeetOnTheWay(const TriangleMesh& robot, const TriangleMesh& obstacle,
                  const QuaternionMotion& motion, double* time) {
  const ExactPairJudge judge(motion);
  bool is_decided = false;
  for (const TriangleCorners& a : CornersOf(robot)) {
    for (const TriangleCorners& b : CornersOf(obstacle)) {
      if (judge.Meet(a, b, 0.0, 1.0, time, &is_decided)) return true;
      EXPECT_TRUE(is_decided);
    }
  }
  return false;
}

TriangleMesh RandomTriangles(int count, std::mt19937_64* random) {
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  TriangleMesh mesh;
  for (int i = 0; i < 3 * count; ++i) {
    mesh.vertices.emplace_back(place(*random), place(*random), place(*random));
  }
  for (int i = 0; i < count; ++i)
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  return mesh;
}

QuaternionMotion RandomMotion(double spread, std::mt19937_64* random) {
  std::uniform_real_distribution<double> place(-spread, spread);
  const auto pose = [&] {
    const Vector3d at(place(*random), place(*random), place(*random));
    return PoseAt(at, Quaterniond(RandomRotation(random)));
  };
  const RobotPose start = pose();
  return Between(start, pose());
}

TEST(QuaternionMotion, TurnsAboutTheAxisOfTheRigidMotionTheShorterWay) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 50; ++i) {
    const QuaternionMotion motion = RandomMotion(1.0, &random);
    const RigidMotion other(motion.start(), motion.end());
    EXPECT_GE(motion.start().orientation.dot(motion.end().orientation), 0.0);
    EXPECT_LE(
        motion.At(1.0).orientation.angularDistance(other.At(1.0).orientation),
        1e-7);
    const Quaterniond turn =
        motion.At(0.3).orientation * motion.start().orientation.conjugate();
    EXPECT_LE(turn.vec().normalized().cross(other.axis()).norm(), 1e-12);
    // Half of the way is half of the turn, for unit quaternions.
    EXPECT_LE(
        motion.At(0.5).orientation.angularDistance(other.At(0.5).orientation),
        1e-7);
    EXPECT_EQ(motion.At(0.5).position, other.At(0.5).position);
  }
}

// An edge at x = 1 in front of a wall: turned from −φ to φ it is there at t = ½
// alone, where two roots fall together.
TEST(QuaternionMotion, IsDecidedExactlyWhereAnEdgeTouchesInAMoment) {
  TriangleMesh diamond = MakePrism(1.0, 0.7, 4);
  for (Vector3d& v : diamond.vertices) {
    v.x() = std::round(v.x());
    v.y() = std::round(v.y());
  }
  ASSERT_EQ(ComputeBounds(diamond).max.x(), 1.0);
  for (const double z : {0.1, 0.3, 0.6}) {
    const double w = std::sqrt(1.0 - z * z);
    const QuaternionMotion motion =
        Between(PoseAt({0, 0, 0}, Quaterniond(w, 0, 0, -z)),
                PoseAt({0, 0, 0}, Quaterniond(w, 0, 0, z)));
    for (const double x : {1.0 - 1e-15, 1.0, std::nextafter(1.0, 2.0)}) {
      const RigidJudge judge(diamond,
                             MakeBox({x, -5.1, -4.0}, {x + 1, 4.0, 3.7}));
      EXPECT_EQ(judge.Check(motion).outcome, MotionVerdict::kUndecided);
      const RigidCheck check = judge.CheckExactly(motion);
      EXPECT_EQ(check.outcome,
                x > 1.0 ? MotionVerdict::kFree : MotionVerdict::kCollides)
          << z << ' ' << x - 1.0;
      if (x <= 1.0) {
        EXPECT_NEAR(check.time, 0.5, 1e-6);
      }
    }
  }
}

// Faces, edges and corners that slide on each other all the way or for a
// moment: conditions that are 0 for all t, in one plane and along one line.
TEST(QuaternionMotion, IsDecidedExactlyOnALattice) {
  const TriangleMesh cube = Cube(2.0);
  const RigidJudge judge(cube, cube);
  const auto check = [&](const Vector3d& a, const Vector3d& b) {
    return judge.CheckExactly(Between(PoseAt(a), PoseAt(b))).outcome;
  };
  const double above = std::nextafter(2.0, 3.0);
  // Across, along, up: to the face above, or past its border.
  const auto outcome = [&](double height, double side) {
    return check({-4, side, height}, {4, side, height});
  };
  EXPECT_EQ(outcome(2.0, 0.0), MotionVerdict::kCollides);
  EXPECT_EQ(outcome(2.0, 2.0), MotionVerdict::kCollides);
  EXPECT_EQ(outcome(above, 0.0), MotionVerdict::kFree);
  EXPECT_EQ(outcome(2.0, above), MotionVerdict::kFree);
  // In one plane, up to a corner, to an edge, and just not.
  EXPECT_EQ(check({5, 2, 2}, {2, 2, 2}), MotionVerdict::kCollides);
  EXPECT_EQ(check({5, 2, 2}, {above, 2, 2}), MotionVerdict::kFree);
  EXPECT_EQ(check({1, 5, 2}, {1, 2, 2}), MotionVerdict::kCollides);
  EXPECT_EQ(check({2, 1, 5}, {2, 1, above}), MotionVerdict::kFree);
}

TEST(QuaternionMotion, OfPairsOfTrianglesIsAsDensePosesSay) {
  std::mt19937_64 random(2);
  int meeting = 0, apart = 0;
  for (int i = 0; i < 120; ++i) {
    const TriangleMesh a = RandomTriangles(1, &random);
    const TriangleMesh b = RandomTriangles(1, &random);
    const QuaternionMotion motion = RandomMotion(1.5, &random);
    double time = 0.0;
    const bool meets = MeetOnTheWay(a, b, motion, &time);
    bool seen = false;
    for (int k = 0; k <= 500 && !seen; ++k) {
      seen = MeetExactly(At(a, motion.At(k / 500.0)), b);
    }
    EXPECT_TRUE(meets || !seen) << i;
    (meets ? meeting : apart) += 1;
    if (!meets) continue;
    // It is the start, or touching ends or begins there.
    seen = false;
    for (const double off : {0.0, 1e-10, -1e-10, 1e-6, -1e-6}) {
      const double t = std::clamp(time + off, 0.0, 1.0);
      seen = seen || MeetExactly(At(a, motion.At(t)), b);
    }
    EXPECT_TRUE(seen) << i << ' ' << time;
  }
  EXPECT_GT(meeting, 25);
  EXPECT_GT(apart, 25);
}

struct MotionTally {
  long cases = 0, free = 0, undecided = 0, wrong_free = 0, wrong_hit = 0,
       wrong_exact = 0;
};

void Compare(const TriangleMesh& robot, const TriangleMesh& obstacle,
             const RigidJudge& judge, const QuaternionMotion& motion,
             MotionTally* tally) {
  double time = 0.0;
  const bool meets = MeetOnTheWay(robot, obstacle, motion, &time);
  const RigidCheck check = judge.Check(motion);
  ++tally->cases;
  if (check.IsFree()) ++tally->free;
  if (check.IsFree() && meets) ++tally->wrong_free;
  if (check.outcome == MotionVerdict::kCollides && !meets) ++tally->wrong_hit;
  if (check.outcome == MotionVerdict::kUndecided) ++tally->undecided;
  if (judge.CheckExactly(motion).IsFree() == meets) ++tally->wrong_exact;
}

// Surfaces that bound nothing, so that meeting is all there is; random motions,
// such cut where they collide, and from contact to contact.
TEST(QuaternionMotion, NoMotionIsCalledFreeThatRationalNumbersRefute) {
  std::mt19937_64 random(4);
  MotionTally tally;
  const long pairs = testing::CampaignCases(8, 200);
  for (long i = 0; i < pairs; ++i) {
    const TriangleMesh robot = RandomTriangles(3, &random);
    const TriangleMesh obstacle = RandomTriangles(3, &random);
    const RigidJudge judge(robot, obstacle);
    RobotPose last = PoseAt({9, 9, 9});
    bool has_last = false;
    for (int k = 0; k < 6; ++k) {
      const QuaternionMotion motion = RandomMotion(2.0, &random);
      Compare(robot, obstacle, judge, motion, &tally);
      if (judge.Check(motion).IsFree()) continue;
      double low = 0.0, high = 1.0;
      const auto cut = [&](double t) {
        return Between(motion.start(), motion.At(t));
      };
      if (!judge.Check(cut(0.0)).IsFree()) continue;
      for (int step = 0; step < 40; ++step) {
        const double t = 0.5 * (low + high);
        (judge.Check(cut(t)).IsFree() ? low : high) = t;
      }
      Compare(robot, obstacle, judge, cut(low), &tally);
      Compare(robot, obstacle, judge, cut(high), &tally);
      const RobotPose contact = motion.At(low);
      if (has_last) {
        Compare(robot, obstacle, judge, Between(last, contact), &tally);
      }
      last = contact;
      has_last = true;
    }
  }
  EXPECT_EQ(tally.wrong_free, 0);
  EXPECT_EQ(tally.wrong_hit, 0);
  EXPECT_EQ(tally.wrong_exact, 0);
  EXPECT_GT(tally.free, tally.cases / 5);
  EXPECT_LT(tally.free, tally.cases * 4 / 5);
  EXPECT_GT(tally.undecided, 0);  // those cut at contact
  testing::ReportCampaign(
      {"motions that turn", "triangles, rational truth", tally.cases,
       tally.wrong_free + tally.wrong_hit + tally.wrong_exact, 0.0, 0.0, "",
       4});
}

TEST(QuaternionMotion, NamesTrianglesWithoutAreaAsUndecidedAndRefusesNoPoses) {
  TriangleMesh point;
  point.vertices = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  point.triangles = {{0, 1, 2}};
  const RigidJudge judge(point, Cube(2.0));
  const RigidCheck check =
      judge.CheckExactly(Between(PoseAt({-3, 0, 0.5}), PoseAt({0, 0, 0.5})));
  EXPECT_EQ(check.outcome, MotionVerdict::kUndecided);
  EXPECT_EQ(check.robot_triangle, 0);
  EXPECT_EQ(judge.CheckExactly(Between(PoseAt({-3, 0, 2}), PoseAt({3, 0, 2})))
                .outcome,
            MotionVerdict::kFree);
  testing::ExpectRefused(
      [&] {
        Between(PoseAt({0, 0, 0}, Quaterniond(1, 1, 0, 0)), PoseAt({0, 0, 0}));
      },
      "quaternion motion: start: expected a unit quaternion");
}

}  // namespace
}  // namespace phongpd
