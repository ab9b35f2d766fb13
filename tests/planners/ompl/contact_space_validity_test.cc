// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: FCL on the original meshes, densely along motions; closed forms.
#include "planners/ompl/contact_space_validity.h"

#include <gtest/gtest.h>
#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/SO3StateSpace.h>

#include <random>

#include "constraints/oracle/collision_oracle.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "planners/retraction/retraction.h"
#include "problems/shapes/shapes.h"
#include "tests/support/oracle_of.h"
#include "tests/support/passages.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

namespace ob = ompl::base;
using Eigen::Vector3d;
using testing::BoxModel;
using testing::Cube;

// Two states to move between.
struct Motion {
  explicit Motion(const ob::SpaceInformationPtr& si) : a(si), b(si), last(si) {}

  void Set(const Vector3d& from, const Vector3d& to) {
    FromPoint(from, a.get());
    FromPoint(to, b.get());
  }

  ob::ScopedState<> a, b, last;
};

TEST(ContactSpaceValidityChecker, IsExactAndKnowsTheClearance) {
  const auto model = BoxModel();
  const ob::SpaceInformationPtr si = MakeSpaceInformation(model);
  ob::ScopedState<> q(si);
  FromPoint({1.5, 0.0, 0.0}, q.get());
  EXPECT_EQ(ToPoint(q.get()), Vector3d(1.5, 0.0, 0.0));
  EXPECT_TRUE(si->isValid(q.get()));
  EXPECT_DOUBLE_EQ(si->getStateValidityChecker()->clearance(q.get()), 0.5);
  double clearance = 0.0;
  EXPECT_TRUE(si->getStateValidityChecker()->isValid(q.get(), clearance));
  EXPECT_DOUBLE_EQ(clearance, 0.5);
  FromPoint({1.0, 0.0, 0.0}, q.get());
  EXPECT_FALSE(si->isValid(q.get()));
  EXPECT_EQ(si->getStateValidityChecker()->clearance(q.get()), 0.0);
  const auto& checker = static_cast<const ContactSpaceValidityChecker&>(
      *si->getStateValidityChecker());
  EXPECT_GE(checker.checks(), 3u);
}

TEST(ContactSpaceMotionValidator, StopsRightBeforeTheFirstContact) {
  const auto model = BoxModel();
  const ob::SpaceInformationPtr si = MakeSpaceInformation(model);
  Motion motion(si);
  motion.Set({-1.9, 0.3, 0.1}, {1.9, 0.3, 0.1});
  std::pair<ob::State*, double> last(motion.last.get(), -1.0);
  EXPECT_FALSE(si->checkMotion(motion.a.get(), motion.b.get(), last));
  EXPECT_NEAR(last.second, 0.9 / 3.8, 1e-8);
  EXPECT_LT(last.second, 0.9 / 3.8);
  // Obstacle-based samples are such states: once so near that FCL disagreed.
  EXPECT_GE(model->free_space().Clearance(ToPoint(motion.last.get())),
            model->floor());
  EXPECT_TRUE(si->isValid(motion.last.get()));
  EXPECT_TRUE(si->checkMotion(motion.a.get(), motion.last.get()));
  // The state may be left out, and may be one of the ends.
  std::pair<ob::State*, double> nothing(nullptr, -1.0);
  EXPECT_FALSE(si->checkMotion(motion.a.get(), motion.b.get(), nothing));
  EXPECT_EQ(nothing.second, last.second);
  std::pair<ob::State*, double> end(motion.b.get(), -1.0);
  EXPECT_FALSE(si->checkMotion(motion.a.get(), motion.b.get(), end));
  EXPECT_EQ(ToPoint(motion.b.get()), ToPoint(motion.last.get()));
  // A free motion touches neither.
  motion.Set({-1.9, 1.3, 0.1}, {1.9, 1.3, 0.1});
  last.second = -1.0;
  const Vector3d before = ToPoint(motion.last.get());
  EXPECT_TRUE(si->checkMotion(motion.a.get(), motion.b.get(), last));
  EXPECT_EQ(last.second, -1.0);
  EXPECT_EQ(ToPoint(motion.last.get()), before);
  // One that starts in collision ends there.
  motion.Set({0.5, 0.0, 0.0}, {1.9, 0.0, 0.0});
  EXPECT_FALSE(si->checkMotion(motion.a.get(), motion.b.get(), last));
  EXPECT_EQ(last.second, 0.0);
  EXPECT_EQ(ToPoint(motion.last.get()), ToPoint(motion.a.get()));
  EXPECT_EQ(si->getMotionValidator()->getValidMotionCount(), 2u);
  EXPECT_EQ(si->getMotionValidator()->getInvalidMotionCount(), 4u);
}

TEST(ContactSpaceMotionValidator, SeesWhatADiscreteOneMisses) {
  const TriangleMesh wall = MakeBox({-1e-6, -9.0, -9.0}, {1e-6, 9.0, 9.0});
  const BoundingBox bounds = {Vector3d::Constant(-1.0),
                              Vector3d::Constant(1.0)};
  const auto model = std::make_shared<const ContactModel>(
      std::vector<ContactSpace>{BuildContactSpace(Cube(1e-6), wall)}, bounds);
  const ob::SpaceInformationPtr si = MakeSpaceInformation(model);
  const ob::DiscreteMotionValidator discrete(si);
  Motion motion(si);
  motion.Set({-0.513, 0.0, 0.0}, {0.521, 0.1, 0.0});
  EXPECT_TRUE(discrete.checkMotion(motion.a.get(), motion.b.get()));
  EXPECT_FALSE(si->checkMotion(motion.a.get(), motion.b.get()));
}

TEST(ContactSpaceMotionValidator, AgreesWithDenseChecksOfTheOriginalMeshes) {
  std::mt19937_64 random(11);
  const TriangleMesh robot = MakeStar(0.2, 0.5);
  const TriangleMesh obstacle =
      Rotated(MakeTorus(1.0, 0.3, 12, 6), testing::RandomRotation(&random));
  const TriangleMesh contact = BuildContactSpace(robot, obstacle).mesh();
  const auto model = std::make_shared<const ContactModel>(
      std::vector<ContactSpace>{TakeAsContactSpace(contact)});
  const ob::SpaceInformationPtr si = MakeSpaceInformation(model);
  const auto oracle = testing::OracleOf<CollisionOracle>(robot, obstacle);
  const double diagonal = model->diagonal();
  Motion motion(si);
  int free = 0, blocked = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vector3d a = UniformPoint(model->region(), &random);
    // Half of them short, where most begin and end free.
    const Vector3d b =
        i % 2 == 0
            ? UniformPoint(model->region(), &random)
            : Vector3d(a + 0.2 * (UniformPoint(model->region(), &random) -
                                  model->region().Center()));
    motion.Set(a, b);
    std::pair<ob::State*, double> last(motion.last.get(), 1.0);
    const bool valid = si->checkMotion(motion.a.get(), motion.b.get(), last);
    ASSERT_EQ(valid, si->checkMotion(motion.a.get(), motion.b.get()));
    const double end = valid ? 1.0 : last.second;
    const int steps = 6;
    for (int k = 0; k <= steps && end > 0.0; ++k) {
      const Vector3d q = a + (end * k / steps) * (b - a);
      // FCL rounds: what is closer to contact than that is left out.
      if (oracle.Collides(q)) {
        ASSERT_LT(model->free_space().Clearance(q), 1e-9 * diagonal) << i;
      }
    }
    if (valid) {
      ++free;
      continue;
    }
    ++blocked;
    // A little beyond the contact something is hit, or the start was.
    if (end == 0.0) {
      ASSERT_TRUE(oracle.Collides(a) ||
                  model->free_space().Clearance(a) < 1e-9 * diagonal);
    } else {
      ASSERT_LT(model->free_space().Clearance(ToPoint(motion.last.get())),
                1e-8 * diagonal);
    }
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(blocked, 1000);
}

TEST(MakeConfigurationSpace, HasTheBoundsOfTheModel) {
  const auto model = BoxModel();
  const auto space = MakeConfigurationSpace(*model);
  EXPECT_EQ(space->getBounds().low, std::vector<double>(3, -2.0));
  EXPECT_EQ(space->getBounds().high, std::vector<double>(3, 2.0));
  EXPECT_NO_THROW(CheckConfigurationSpace("test", *space));
}

TEST(CheckConfigurationSpace, RefusesOtherSpaces) {
  const ob::RealVectorStateSpace plane(2);
  const ob::SO3StateSpace turns;  // of dimension 3
  for (const ob::StateSpace* space :
       {static_cast<const ob::StateSpace*>(&plane),
        static_cast<const ob::StateSpace*>(&turns)}) {
    EXPECT_THROW(CheckConfigurationSpace("test", *space), InputError);
  }
}

TEST(MakeSpaceInformation, NeedsAModel) {
  EXPECT_THROW(MakeSpaceInformation(nullptr), InputError);
}

}  // namespace
}  // namespace phongpd
