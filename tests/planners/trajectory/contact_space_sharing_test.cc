// SPDX-License-Identifier: GPL-3.0-or-later
// What judges, planners and optimisers share of a contact space: the tree, and
// one length.
#include <gtest/gtest.h>

#include "constraints/free_space.h"
#include "constraints/signed_metric.h"
#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/start_repair.h"
#include "planners/retraction/contact_model.h"
#include "planners/trajectory/trajectory_problem.h"
#include "problems/shapes/shapes.h"
#include "tests/support/metrics.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

TEST(ContactSpaceHandle, OneTreeServesEverythingThatTakesIt) {
  const ContactSpace space =
      BuildContactSpace(MakeCone(0.5, 1.0, 7), MakeU(3.0, 1.0, 1.0));
  const long before = TriangleBvh::CountBuilt();
  const EuclideanMetric euclidean(space);
  const PhongMetric phong = testing::UnsmoothedPhong(space);
  const SignedMetric rows(space);
  const FreeSpace judge({space});
  const StartRepair repair(space);
  const ContactSurfacePlanner planner(space);
  const ContactModel model({space});
  const TrajectoryProblem problem = MakeTrajectoryProblem({space});
  EXPECT_EQ(TriangleBvh::CountBuilt() - before, 1);
  EXPECT_TRUE(judge.spaces()[0].SharesWith(space));
  EXPECT_TRUE(model.space(0).SharesWith(space));
  EXPECT_TRUE(problem.metrics[0]->space().SharesWith(space));
  EXPECT_EQ(&judge.spaces()[0].mesh(), &space.mesh());
}

// Obstacles of different sizes in one problem: one ℓ, one reach, one margin,
// in the user's unit.
TEST(ContactSpaceHandle, ObstaclesOfOneProblemHaveOneLength) {
  const TriangleMesh robot = MakeCone(0.1, 0.2, 5);
  const ContactSpace small = BuildContactSpace(robot, MakeCone(0.3, 0.5, 5));
  const ContactSpace large = BuildContactSpace(
      robot, Translated(MakeBox({-4, -4, -4}, {4, 4, 4}), {9.0, 0.0, 0.0}));
  const TrajectoryProblem problem = MakeTrajectoryProblem({small, large});
  const double d = problem.metrics[0]->space().length();
  EXPECT_EQ(problem.metrics[1]->space().length(), d);
  EXPECT_EQ(Diagonal(problem), d);
  const BoundingBox a = small.bounds(), b = large.bounds();
  EXPECT_EQ(d, (a.max.cwiseMax(b.max) - a.min.cwiseMin(b.min)).norm());
  // Two of one size, whose diagonals agree by chance, are no exception.
  const auto same =
      WithCommonLength({TakeAsContactSpace(MakeBox({0, 0, 0}, {1, 1, 1})),
                        TakeAsContactSpace(MakeBox({4, 0, 0}, {5, 1, 1}))});
  EXPECT_EQ(same[0].length(), Vector3d(5, 1, 1).norm());
  EXPECT_EQ(same[1].length(), Vector3d(5, 1, 1).norm());
  // Spaces that were given one already keep it.
  const auto given =
      WithCommonLength({small.WithLength(3), large.WithLength(3)});
  EXPECT_EQ(given[0].length(), 3.0);
  EXPECT_EQ(given[1].length(), 3.0);
}

}  // namespace
}  // namespace phongpd
