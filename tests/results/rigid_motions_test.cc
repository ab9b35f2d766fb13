// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: OMPL's own count of segments, and FCL at samples.
#include "results/bench/rigid_motions.h"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>

#include "constraints/oracle/fcl_surfaces.h"
#include "planners/ompl/rigid_motion_validator.h"

namespace phongpd::bench {
namespace {

TEST(RigidMotions, HaveFreeEndsAndAreWhatTheirKindSays) {
  for (const char* name : {"peg", "window"}) {
    const RigidScene scene = MakeRigidScene(name);
    const RigidJudge judge({scene.robot}, scene.obstacles);
    for (const RigidMotionKind kind :
         {RigidMotionKind::kRandom, RigidMotionKind::kContact,
          RigidMotionKind::kGrazing}) {
      const std::vector<RigidMotionEnds> motions =
          MakeRigidMotions(scene, judge, kind, 20, 7);
      ASSERT_EQ(motions.size(), 20u) << name << ' ' << ToString(kind);
      int free = 0;
      for (std::size_t i = 0; i < motions.size(); ++i) {
        const auto& [a, b] = motions[i];
        EXPECT_TRUE(judge.Check(RigidMotion(a, a)).IsFree());
        EXPECT_TRUE(judge.Check(RigidMotion(b, b)).IsFree());
        const bool is_free = judge.Check(RigidMotion(a, b)).IsFree();
        free += is_free ? 1 : 0;
        if (kind != RigidMotionKind::kGrazing) continue;
        EXPECT_EQ(is_free, i % 2 == 0) << i;
        if (i % 2 == 0) {
          EXPECT_LT((b.position - motions[i + 1].end.position).norm(),
                    2e-6 * scene.bounds.Diagonal());
        }
      }
      EXPECT_GT(free, 0);
      EXPECT_LT(free, 20);
      const auto again = MakeRigidMotions(scene, judge, kind, 20, 7);
      EXPECT_EQ(again.back().end.position, motions.back().end.position);
    }
  }
}

TEST(RigidMotions, AreLookedAtAsOftenAsOmplWould) {
  const RigidScene scene = MakeRigidScene("peg");
  const RigidJudge judge({scene.robot}, scene.obstacles);
  const auto space = MakePoseSpace(scene.bounds);
  ompl::base::ScopedState<> a(space), b(space);
  for (const double resolution : {0.01, 0.001}) {
    space->setLongestValidSegmentFraction(resolution);
    space->setup();
    for (const RigidMotionEnds& ends :
         MakeRigidMotions(scene, judge, RigidMotionKind::kRandom, 50, 3)) {
      FromRobotPose(ends.start, a.get());
      FromRobotPose(ends.end, b.get());
      EXPECT_EQ(OmplParts(scene, ends, resolution),
                static_cast<int>(space->validSegmentCount(a.get(), b.get())));
    }
  }
}

// FclSurfaces at poses and along motions that turn: a rod and a plate.
TEST(FclSurfaces, TurnsARobotAboutItsOrigin) {
  const FclSurfaces fcl(MakeRigidScene("bugtrap").robot,
                        MakeRigidScene("peg").obstacles[0]);
  const RobotPose across{{3.0, 0.0, 1.3}, Eigen::Quaterniond::Identity()};
  RobotPose down = across;
  down.orientation =
      Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitY());
  // The rod is 0.8 long from its middle, and the plate ends at z = 1.
  EXPECT_FALSE(fcl.Meet(across));
  EXPECT_TRUE(fcl.Meet(down));
  EXPECT_TRUE(fcl.Meet(across, down, FclSurfaces::Solver::kPlacements));
  down.position.z() = 2.5;
  EXPECT_FALSE(fcl.Meet(down));
  EXPECT_FALSE(fcl.Meet(down, down, FclSurfaces::Solver::kPlacements));
}

}  // namespace
}  // namespace phongpd::bench
