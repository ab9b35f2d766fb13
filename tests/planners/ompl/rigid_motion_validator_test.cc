// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms, OMPL's own interpolation, and CGAL's exact kernel on
// the meshes put in place densely along motions.
#include "planners/ompl/rigid_motion_validator.h"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"
#include "tests/support/rigid_truth.h"

namespace phongpd {
namespace {

namespace ob = ompl::base;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kReach = 4.0;
const BoundingBox kRegion{Vector3d::Constant(-kReach),
                          Vector3d::Constant(kReach)};

// A bar along x and a post along z that it meets when it has turned far enough.
TriangleMesh Bar() { return MakeBox({-2, -0.1, -0.1}, {2, 0.1, 0.1}); }
TriangleMesh Post() { return MakeBox({0.9, 0.9, -1}, {1.1, 1.1, 1}); }

RobotPose Turned(double angle, const Vector3d& axis = Vector3d::UnitZ(),
                 const Vector3d& position = Vector3d::Zero()) {
  return {position, Quaterniond(AngleAxisd(angle, axis))};
}

RobotPose RandomPose(std::mt19937_64* random) {
  std::uniform_real_distribution<double> coordinate(-kReach, kReach);
  std::normal_distribution<double> normal;
  RobotPose pose;
  for (int k = 0; k < 3; ++k) pose.position[k] = coordinate(*random);
  for (int k = 0; k < 4; ++k) pose.orientation.coeffs()[k] = normal(*random);
  pose.orientation.normalize();
  return pose;
}

// Two states to move between.
struct PoseMotion {
  explicit PoseMotion(const ob::SpaceInformationPtr& si)
      : info(si), a(si), b(si), last(si) {}
  bool IsFree(const RobotPose& from, const RobotPose& to) {
    FromRobotPose(from, a.get());
    FromRobotPose(to, b.get());
    return info->checkMotion(a.get(), b.get());
  }
  // The fraction of the way that is free; the state is in `last`.
  double LastValid(const RobotPose& from, const RobotPose& to) {
    FromRobotPose(from, a.get());
    FromRobotPose(to, b.get());
    std::pair<ob::State*, double> valid(last.get(), -1.0);
    const bool is_free = info->checkMotion(a.get(), b.get(), valid);
    return is_free ? 1.0 : valid.second;
  }
  const RigidMotionValidator& validator() const {
    return static_cast<const RigidMotionValidator&>(
        *info->getMotionValidator());
  }
  ob::SpaceInformationPtr info;
  ob::ScopedState<> a, b, last;
};

ob::SpaceInformationPtr BarBesidePost() {
  return MakeRigidSpaceInformation(RigidJudge(Bar(), Post()), kRegion);
}

TEST(RigidMotionValidator, SeesWhatATurnSweepsOver) {
  PoseMotion motion(BarBesidePost());
  // Free at both ends, and the post is between them.
  EXPECT_TRUE(motion.IsFree(Turned(0.0), Turned(0.5)));
  EXPECT_TRUE(motion.IsFree(Turned(1.1), Turned(kPi / 2)));
  EXPECT_FALSE(motion.IsFree(Turned(0.0), Turned(kPi / 2)));
  EXPECT_EQ(motion.validator().getValidMotionCount(), 2u);
  EXPECT_EQ(motion.validator().getInvalidMotionCount(), 1u);
  EXPECT_EQ(motion.validator().undecided(), 0u);
}

TEST(RigidMotionValidator, ReturnsTheLastPoseByBisection) {
  PoseMotion motion(BarBesidePost());
  // The bar's upper side, 0.1 from its axis, meets the post's corner
  // (1.1, 0.9) at atan2(0.9, 1.1) less the angle that 0.1 is of its distance.
  const double contact =
      std::atan2(0.9, 1.1) - std::asin(0.1 / std::hypot(1.1, 0.9));
  const double turn = 1.5;
  const double fraction = motion.LastValid(Turned(0.0), Turned(turn));
  EXPECT_LT(fraction, contact / turn);
  EXPECT_GT(fraction, contact / turn - 1.0 / 256.0);
  const RobotPose last = ToRobotPose(motion.last.get());
  EXPECT_LT(
      last.orientation.angularDistance(Turned(fraction * turn).orientation),
      1e-14);
  // What is said to be free is, for the very state written.
  EXPECT_TRUE(motion.IsFree(Turned(0.0), last));
  EXPECT_TRUE(motion.info->isValid(motion.last.get()));
}

TEST(RigidMotionValidator, WritesTheLastPoseOverTheEndOrNowhere) {
  PoseMotion motion(BarBesidePost());
  const double fraction = motion.LastValid(Turned(0.0), Turned(1.5));
  FromRobotPose(Turned(0.0), motion.a.get());
  FromRobotPose(Turned(1.5), motion.b.get());
  std::pair<ob::State*, double> over(motion.b.get(), -1.0);
  EXPECT_FALSE(motion.info->checkMotion(motion.a.get(), motion.b.get(), over));
  EXPECT_EQ(over.second, fraction);
  EXPECT_EQ(ToRobotPose(motion.b.get()).orientation.coeffs(),
            ToRobotPose(motion.last.get()).orientation.coeffs());
  FromRobotPose(Turned(1.5), motion.b.get());
  std::pair<ob::State*, double> none(nullptr, -1.0);
  EXPECT_FALSE(motion.info->checkMotion(motion.a.get(), motion.b.get(), none));
  EXPECT_EQ(none.second, fraction);
  // From a pose in collision nothing is free.
  EXPECT_EQ(motion.LastValid(Turned(kPi / 4), Turned(0.0)), 0.0);
}

TEST(RigidMotionValidator, JudgesTheWayThatOmplInterpolates) {
  const auto space = MakePoseSpace(kRegion);
  std::mt19937_64 random(1);
  ob::ScopedState<> a(space), b(space), c(space);
  int negative = 0;
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const RobotPose from = RandomPose(&random), to = RandomPose(&random);
    FromRobotPose(from, a.get());
    FromRobotPose(to, b.get());
    const double dot = from.orientation.dot(to.orientation);
    negative += dot < 0.0 ? 1 : 0;
    const RigidMotion motion(from, to);
    for (const double t : {0.1, 0.5, 0.9, 1.0}) {
      space->interpolate(a.get(), b.get(), t, c.get());
      const RobotPose there = ToRobotPose(c.get());
      worst = std::max(
          {worst, (there.position - motion.At(t).position).norm(),
           there.orientation.angularDistance(motion.At(t).orientation)});
    }
  }
  EXPECT_GT(negative, 800);  // orientations of either sign were met
  EXPECT_LT(worst, 1e-7);    // an angle from a cosine: to the root of an ulp
}

TEST(RigidMotionValidator, RefusesHalfTurnsWhoseWayHangsOnRounding) {
  // Nothing is in the way but the post, far below.
  PoseMotion motion(MakeRigidSpaceInformation(
      RigidJudge(Bar(), MakeBox({-1, -1, -9}, {1, 1, -8})), kRegion));
  for (const double off : {0.0, 1e-13, -1e-10, 4e-10}) {
    EXPECT_FALSE(motion.IsFree(Turned(0.0), Turned(kPi + off))) << off;
    EXPECT_EQ(motion.LastValid(Turned(0.0), Turned(kPi + off)), 0.0) << off;
  }
  EXPECT_EQ(motion.validator().half_turns(), 8u);
  for (const double off : {1e-8, -1e-8, 1e-6}) {
    EXPECT_TRUE(motion.IsFree(Turned(0.0), Turned(kPi + off))) << off;
  }
  EXPECT_EQ(motion.validator().half_turns(), 8u);
  EXPECT_EQ(motion.validator().undecided(), 0u);
}

TEST(RigidMotionValidator, CountsWhatIsUndecidedAsNotValid) {
  // Bar on a floor: its underside slides in the floor's plane.
  PoseMotion motion(MakeRigidSpaceInformation(
      RigidJudge(Bar(), MakeBox({-5, -5, -1}, {5, 5, -0.1})), kRegion));
  EXPECT_FALSE(motion.IsFree(Turned(0.0), Turned(0.3)));
  EXPECT_EQ(motion.validator().undecided(), 1u);
  FromRobotPose(Turned(0.0), motion.a.get());
  EXPECT_FALSE(motion.info->isValid(motion.a.get()));
  const auto& checker = static_cast<const RigidValidityChecker&>(
      *motion.info->getStateValidityChecker());
  EXPECT_EQ(checker.undecided(), 1u);
  EXPECT_EQ(checker.checks(), 1u);
}

TEST(RigidMotionValidator, AgreesWithExactCollisionAlongRandomMotions) {
  const TriangleMesh robot = MakeL(1.5, 0.4, 0.3);
  const TriangleMesh world = MakePlateWithHole(5, 0.5, 1.6);
  PoseMotion motion(
      MakeRigidSpaceInformation(RigidJudge(robot, world), kRegion));
  std::mt19937_64 random(2);
  int free = 0, cut = 0;
  for (int i = 0; i < 120; ++i) {
    const RobotPose from = RandomPose(&random);
    RobotPose to = RandomPose(&random);
    FromRobotPose(from, motion.a.get());
    if (!motion.info->isValid(motion.a.get())) continue;
    const double fraction = motion.LastValid(from, to);
    free += fraction == 1.0 ? 1 : 0;
    cut += fraction > 0.0 && fraction < 1.0 ? 1 : 0;
    if (fraction < 1.0) to = ToRobotPose(motion.last.get());
    const RigidMotion part(from, to);
    for (int k = 0; k <= 20; ++k) {
      ASSERT_FALSE(testing::MeetExactly(
          testing::PlacedMesh(robot, part, k / 20.0), world))
          << i << ' ' << k;
    }
  }
  EXPECT_GT(free, 10);
  EXPECT_GT(cut, 10);
}

TEST(RigidValidityChecker, IsFalseOutsideOfTheSpace) {
  const ob::SpaceInformationPtr si = BarBesidePost();
  ob::ScopedState<> state(si), other(si);
  const auto is_valid = [&](const RobotPose& pose) {
    FromRobotPose(pose, state.get());
    return si->isValid(state.get());
  };
  EXPECT_TRUE(is_valid(Turned(0.0)));
  EXPECT_FALSE(is_valid(Turned(kPi / 4)));  // in the post
  EXPECT_FALSE(is_valid({{kReach + 1.0, 0, 0}, Quaterniond::Identity()}));
  EXPECT_FALSE(is_valid({Vector3d::Zero(), Quaterniond(1.1, 0, 0, 0)}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  FromRobotPose(Turned(0.0), other.get());
  for (const RobotPose& bad :
       {RobotPose{{nan, 0, 0}, Quaterniond::Identity()},
        RobotPose{Vector3d::Zero(), Quaterniond(nan, 0, 0, 0)}}) {
    EXPECT_FALSE(is_valid(bad));
    EXPECT_FALSE(si->checkMotion(other.get(), state.get()));
    EXPECT_FALSE(si->checkMotion(state.get(), other.get()));
  }
}

TEST(RigidMotionValidator, WantsPosesAndARegion) {
  const auto vectors = std::make_shared<ob::RealVectorStateSpace>(6);
  const auto si = std::make_shared<ob::SpaceInformation>(vectors);
  EXPECT_THROW(RigidMotionValidator(si, RigidJudge(Bar(), Post())), InputError);
  EXPECT_THROW(RigidValidityChecker(si, RigidJudge(Bar(), Post())), InputError);
  EXPECT_THROW(MakePoseSpace({Vector3d::Zero(), Vector3d(1, 1, 0)}),
               InputError);
  EXPECT_THROW(MakePoseSpace({Vector3d::Zero(),
                              Vector3d::Constant(
                                  std::numeric_limits<double>::infinity())}),
               InputError);
}

TEST(RigidMotionValidator, LetsAPlannerOfOmplReturnProvedPaths) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  const RigidJudge judge(MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1}),
                         MakePlateWithHole(16, 0.5, 2.5));
  const ob::SpaceInformationPtr si = MakeRigidSpaceInformation(judge, kRegion);
  ompl::geometric::SimpleSetup setup(si);
  ob::ScopedState<> start(si), goal(si);
  FromRobotPose(Turned(1.0, Vector3d::UnitX(), {0, 0, 2}), start.get());
  FromRobotPose(Turned(1.0, Vector3d::UnitY(), {0, 0, -2}), goal.get());
  setup.setStartAndGoalStates(start, goal);
  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(si));
  ASSERT_EQ(setup.solve(60.0), ob::PlannerStatus::EXACT_SOLUTION);
  const auto& states = setup.getSolutionPath().getStates();
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    EXPECT_TRUE(judge
                    .Check(RigidMotion(ToRobotPose(states[i]),
                                       ToRobotPose(states[i + 1])))
                    .IsFree())
        << i;
  }
  EXPECT_GT(states.size(), 2u);
}

}  // namespace
}  // namespace phongpd
