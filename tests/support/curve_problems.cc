// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/curve_problems.h"

#include <gtest/gtest.h>

#include "constraints/curve_judge.h"
#include "planners/exact/contact_surface_planner.h"
#include "tests/support/path_problems.h"

namespace phongpd::testing {

using Eigen::Vector3d;

MotionLimits PlainLimits(bool by_norm) {
  MotionLimits limits;
  limits.velocity.setConstant(1.0);
  limits.acceleration.setConstant(2.0);
  limits.jerk.setConstant(10.0);
  limits.by_norm = by_norm;
  return limits;
}

const std::vector<std::string>& CurveFamilies() {
  static const std::vector<std::string> families = {
      "Uaxis", "L",         "plate0.02", "hole",
      "torus", "cone_axes", "clutter",   "channel0.001"};
  return families;
}

FreePath PlanFreePath(const std::string& family, std::uint64_t seed) {
  const PathProblem problem = MakePathProblem(family, seed);
  const ContactSpace contact = TakeAsContactSpace(problem.contact);
  const PlanResult plan =
      ContactSurfacePlanner(contact).Plan(problem.start, problem.goal);
  return {FreeSpace({contact}), ComputeBounds(problem.contact).Diagonal(),
          plan.path};
}

void ExpectCertified(const FreeSpace& space, const std::vector<Vector3d>& path,
                     const MotionLimits& limits, const CurveSummary& summary) {
  const Trajectory& curve = summary.trajectory;
  ASSERT_FALSE(curve.empty());
  EXPECT_TRUE(CheckCurve(space, curve).IsFree());
  EXPECT_TRUE(BoundLimitUse(curve, limits).IsKept());
  EXPECT_EQ(curve.pieces().front().front(), path.front());
  EXPECT_EQ(curve.pieces().back().back(), path.back());
  EXPECT_EQ(summary.duration, curve.duration());
  EXPECT_LT(curve.JointGap(1), 1e-7);
  EXPECT_LT(curve.JointGap(2), 1e-6);
  EXPECT_LE(summary.duration, summary.stops_duration * (1.0 + 1e-9));
}

}  // namespace phongpd::testing
