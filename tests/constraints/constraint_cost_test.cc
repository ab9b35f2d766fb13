// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluating rows and judging motions allocates nothing, checked by counting
// every allocation of the process.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "constraints/non_penetration.h"
#include "constraints/rigid/rigid_judge.h"
#include "problems/shapes/shapes.h"
#include "tests/support/count_allocations.h"

namespace phongpd {
namespace {

TEST(ConstraintCost, EvaluatingDoesNotAllocate) {
  const auto metric = std::make_shared<SignedMetric>(
      TakeAsContactSpace(MakeTorus(1.0, 0.35, 40, 16)));
  const std::vector<int> samples(9, 2);
  const NonPenetrationConstraint rows({metric, metric}, {-2, 0.1, 0},
                                      {2, 0, 0.1}, 8, samples, 3);
  std::vector<double> u(static_cast<std::size_t>(rows.variables()));
  for (std::size_t i = 0; i < u.size(); ++i) {
    u[i] = 1.2 * std::sin(static_cast<double>(3 * i));
  }
  std::vector<double> values(static_cast<std::size_t>(rows.rows()));
  std::vector<double> jacobian(static_cast<std::size_t>(rows.nonzeros()));
  NonPenetrationCounts counts;
  BranchSet branches = rows.Start(u.data(), &counts);
  const long before = allocations;
  for (int i = 0; i < 200; ++i) {
    u[static_cast<std::size_t>(i) % u.size()] += 1e-3 * i;
    ASSERT_TRUE(rows.Evaluate(u.data(), branches, values.data(),
                              jacobian.data(), &counts));
    rows.Commit(u.data(), &branches, &counts);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(counts.warm, 100);
}

TEST(ConstraintCost, JudgingARigidMotionDoesNotAllocate) {
  const RigidJudge judge(MakeBlob(1.0, 2, 0.1, 1), MakeBlob(1.0, 2, 0.1, 2));
  long free = 0, counted = 0;
  for (int i = 0; i < 50; ++i) {
    RobotPose start, end;
    start.position = {-3.0, 0.07 * i, 0.0};
    end.position = {3.0, 0.05 * i, 1.0};
    end.orientation =
        Eigen::AngleAxisd(0.04 * i, Eigen::Vector3d(0.6, 0.0, 0.8));
    const RigidMotion motion(start, end);
    const long before = allocations;
    free += judge.Check(motion).IsFree() ? 1 : 0;
    counted += allocations - before;
  }
  EXPECT_EQ(counted, 0);
  EXPECT_GT(free, 10);
  EXPECT_LT(free, 40);
}

}  // namespace
}  // namespace phongpd
