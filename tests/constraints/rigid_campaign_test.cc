// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: poses sampled densely and judged in CGAL's exact kernel, and for
// motions that only translate the exact oracle.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "constraints/motion_oracle.h"
#include "constraints/rigid/rigid_judge.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/random_pairs.h"
#include "tests/support/rigid_truth.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::MeetExactly;
using testing::PlacedMesh;
using testing::PoseAt;
using testing::RandomRotation;
using testing::RandomVoxelSolid;

struct CampaignTally {
  long cases = 0, free = 0, undecided = 0, wrong_free = 0, wrong_hit = 0;
};

// Against `poses` sampled on the way, all in the exact kernel.
void Compare(const RigidJudge& judge, const TriangleMesh& robot,
             const TriangleMesh& obstacle, const RigidMotion& motion, int poses,
             CampaignTally* tally) {
  const RigidCheck check = judge.Check(motion);
  ++tally->cases;
  if (check.outcome == MotionVerdict::kUndecided) ++tally->undecided;
  if (check.outcome == MotionVerdict::kCollides && check.robot_triangle >= 0 &&
      !MeetExactly(PlacedMesh(robot, motion, check.time), check.robot_triangle,
                   obstacle, check.obstacle_triangle)) {
    ++tally->wrong_hit;
  }
  if (!check.IsFree()) return;
  ++tally->free;
  for (int k = 0; k <= poses; ++k) {
    const double t = static_cast<double>(k) / poses;
    if (MeetExactly(PlacedMesh(robot, motion, t), obstacle)) {
      ++tally->wrong_free;
      ADD_FAILURE() << "free, but collides at " << t;
      return;
    }
  }
}

RigidMotion RandomMotion(double spread, double turn, std::mt19937_64* random) {
  std::uniform_real_distribution<double> place(-spread, spread);
  const Vector3d a(place(*random), place(*random), place(*random));
  const Vector3d b(place(*random), place(*random), place(*random));
  const Vector3d axis = RandomRotation(random).col(0);
  std::uniform_real_distribution<double> angle(0.0, turn);
  return RigidMotion::Turning(PoseAt(a, Quaterniond(RandomRotation(random))), b,
                              angle(*random) * axis);
}

TEST(RigidCampaign, CallsNoRandomMotionFreeThatAnExactPoseRefutes) {
  std::mt19937_64 random(7);
  CampaignTally tally;
  const std::vector<PairKind>& kinds = AllPairKinds();
  const long pairs = testing::CampaignCases(40, 400);
  for (long i = 0; i < pairs; ++i) {
    TriangleMesh robot, obstacle;
    if (i % 2 == 0) {
      robot = RandomVoxelSolid(2, 0.6, &random);
      obstacle = RandomVoxelSolid(3, 0.5, &random);
    } else {
      const SolidPair pair =
          MakeRandomPair(kinds[static_cast<std::size_t>(i) % kinds.size()],
                         static_cast<std::uint64_t>(i));
      robot = pair.robot;
      obstacle = pair.obstacle;
      if (robot.triangles.size() * obstacle.triangles.size() > 20000) continue;
    }
    const double spread = 0.3 * ComputeBounds(robot).Diagonal() +
                          0.5 * ComputeBounds(obstacle).Diagonal();
    const RigidJudge judge(robot, obstacle);
    for (int k = 0; k < 60; ++k) {
      Compare(judge, robot, obstacle,
              RandomMotion(spread, k % 5 == 0 ? 2.0 * kPi : 1.0, &random), 60,
              &tally);
    }
    Compare(judge, robot, obstacle, RandomMotion(spread, 0.3, &random), 10'000,
            &tally);
  }
  EXPECT_EQ(tally.wrong_free, 0);
  EXPECT_EQ(tally.wrong_hit, 0);
  EXPECT_GT(tally.free, tally.cases / 10);
  EXPECT_LT(tally.free, tally.cases * 9 / 10);
  EXPECT_LE(tally.undecided, tally.cases / 1000);
}

// From contact to contact, where most motions graze.
TEST(RigidCampaign, CallsNoGrazingMotionFreeThatAnExactPoseRefutes) {
  std::mt19937_64 random(8);
  CampaignTally tally;
  const long pairs = testing::CampaignCases(15, 150);
  for (long i = 0; i < pairs; ++i) {
    const TriangleMesh robot = RandomVoxelSolid(2, 0.6, &random);
    const TriangleMesh obstacle = RandomVoxelSolid(3, 0.5, &random);
    const RigidJudge judge(robot, obstacle);
    const double spread = 3.0;
    for (int k = 0; k < 100; ++k) {
      // Pushed on from free until no longer so, by halving.
      const RigidMotion way = RandomMotion(spread, 2.0, &random);
      const auto upto = [&](double t) {
        return RigidMotion::Turning(way.start(), way.At(t).position,
                                    t * way.turn());
      };
      double low = 0.0, high = 1.0;
      if (judge.Check(way).IsFree() || !judge.Check(upto(0.0)).IsFree()) {
        continue;
      }
      for (int step = 0; step < 26; ++step) {
        const double t = 0.5 * (low + high);
        (judge.Check(upto(t)).IsFree() ? low : high) = t;
      }
      Compare(judge, robot, obstacle, upto(low), 300, &tally);
      // And sideways from there.
      const RobotPose contact = way.At(low);
      const RigidMotion side = RigidMotion::Turning(
          contact, contact.position + 0.1 * RandomRotation(&random).col(0),
          0.1 * RandomRotation(&random).col(1));
      Compare(judge, robot, obstacle, side, 300, &tally);
    }
  }
  EXPECT_EQ(tally.wrong_free, 0);
  EXPECT_EQ(tally.wrong_hit, 0);
  EXPECT_GE(tally.cases, 200);
  EXPECT_GT(tally.free, tally.cases / 2);
}

// Needles and slivers of any direction, 1e-7 thin.
TEST(RigidCampaign, JudgesNeedles) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  CampaignTally tally;
  for (int i = 0; i < 300; ++i) {
    const auto needles = [&] {
      TriangleMesh mesh;
      for (int k = 0; k < 4; ++k) {
        const Vector3d a(place(random), place(random), place(random));
        const Vector3d b(place(random), place(random), place(random));
        const Vector3d aside = 1e-7 * RandomRotation(&random).col(0);
        const Vector3d c = k % 2 == 0 ? a : Vector3d(0.5 * (a + b));
        mesh.vertices.insert(mesh.vertices.end(), {a, b, Vector3d(c + aside)});
        mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
      }
      return mesh;
    };
    const TriangleMesh robot = needles(), obstacle = needles();
    const RigidJudge judge(robot, obstacle);
    for (int k = 0; k < 10; ++k) {
      const RigidMotion motion = RandomMotion(1.0, 1.0, &random);
      Compare(judge, robot, obstacle, motion, 200, &tally);
    }
  }
  EXPECT_EQ(tally.wrong_free, 0);
  EXPECT_EQ(tally.wrong_hit, 0);
  EXPECT_GT(tally.free, 300);
  EXPECT_LT(tally.free, 2700);
}

TEST(RigidCampaign, AgreesWithTheExactOracleOnTranslations) {
  std::mt19937_64 random(10);
  long cases = 0, undecided = 0, free = 0;
  for (int i = 0; i < 40; ++i) {
    // Half of them in general position, half on a lattice.
    TriangleMesh a = RandomVoxelSolid(3, 0.5, &random);
    TriangleMesh b = RandomVoxelSolid(3, 0.6, &random);
    const bool is_general = i % 2 == 0;
    if (is_general) {
      a = Rotated(a, RandomRotation(&random));
      b = Rotated(b, RandomRotation(&random));
    }
    const RigidJudge judge(a, b);
    const MotionOracle oracle(MakeSolid(a, "a"), MakeSolid(b, "b"));
    for (int k = 0; k < 100; ++k) {
      std::uniform_real_distribution<double> place(-4.0, 4.0);
      Vector3d p(place(random), place(random), place(random));
      Vector3d q(place(random), place(random), place(random));
      if (!is_general && k % 2 == 0) {
        p = p.array().round();
        q = q.array().round();
      }
      const RigidCheck check = judge.Check({PoseAt(p), PoseAt(q)});
      const bool collides = oracle.Collides(p, q);
      ++cases;
      if (check.IsFree()) {
        ++free;
        EXPECT_FALSE(collides) << i << ' ' << k;
      }
      if (check.outcome == MotionVerdict::kCollides) {
        EXPECT_TRUE(collides);
      }
      if (check.outcome == MotionVerdict::kUndecided && is_general) ++undecided;
    }
  }
  EXPECT_EQ(cases, 4000);
  EXPECT_GT(free, 500);
  EXPECT_LE(undecided, 4);
}

}  // namespace
}  // namespace phongpd
