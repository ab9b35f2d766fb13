// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_judge.h"

#include <algorithm>
#include <utility>

#include "constraints/rigid/clearance_search.h"
#include "constraints/rigid/rigid_search.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/numbers.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

using internal::FramedMotion;
using internal::RigidSides;

constexpr double kMaxRigidSize = 1e100;

// Throws InputError for a motion that rounding does not stand.
template <typename Motion>
FramedMotion Framed(const RigidSides& sides, const Motion& motion) {
  const FramedMotion framed(motion, sides.frame, sides.robot.tree.reach,
                            sides.obstacle.tree.reach);
  if (!(framed.size() <= kMaxRigidSize)) {
    throw InputError(
        "rigid judge: expected a motion within 1e100 sizes of the meshes, "
        "found one to " +
        Rounded(std::max(motion.start().position.cwiseAbs().maxCoeff(),
                         motion.end().position.cwiseAbs().maxCoeff())) +
        "; are the units right?");
  }
  return framed;
}

// Of one motion, which is number `number`; *known of those before, in the
// frame.
RigidClearance ClearanceOf(const RigidSides& sides, const FramedMotion& motion,
                           int number, const ClearanceTolerance& tolerance,
                           long max_tests, double* known) {
  const internal::FramedClearance found = internal::SearchClearance(
      sides, motion, tolerance.relative, tolerance.absolute * sides.frame.scale,
      *known, max_tests);
  *known = found.upper;
  RigidClearance clearance = internal::InUsersUnit(sides, found);
  clearance.motion = number;
  return clearance;
}

}  // namespace

struct RigidJudge::Impl : internal::RigidSides {};

RigidJudge::RigidJudge(const TriangleMesh& robot, const TriangleMesh& obstacle)
    : RigidJudge(std::vector<TriangleMesh>{robot},
                 std::vector<TriangleMesh>{obstacle}) {}

RigidJudge::RigidJudge(const std::vector<TriangleMesh>& robot,
                       const std::vector<TriangleMesh>& obstacles) {
  internal::RequireRigidMeshes(robot, "robot");
  internal::RequireRigidMeshes(obstacles, "obstacle");
  auto impl = std::make_shared<Impl>();
  impl->frame = internal::RigidFrameOf(robot, obstacles);
  impl->robot = internal::MakeRigidSide(robot, Eigen::Vector3d::Zero(),
                                        impl->frame.scale);
  impl->obstacle =
      internal::MakeRigidSide(obstacles, impl->frame.center, impl->frame.scale);
  impl_ = std::move(impl);
}

RigidCheck RigidJudge::Check(const RigidMotion& motion, long max_tests) const {
  return internal::SearchAnyHit(*impl_, Framed(*impl_, motion), max_tests);
}

RigidCheck RigidJudge::Check(const QuaternionMotion& motion,
                             long max_tests) const {
  return internal::SearchAnyHit(*impl_, Framed(*impl_, motion), max_tests);
}

RigidCheck RigidJudge::CheckExactly(const QuaternionMotion& motion,
                                    long max_tests) const {
  return internal::SearchExactly(*impl_, Framed(*impl_, motion), motion,
                                 max_tests);
}

RigidFirstHit RigidJudge::FirstHit(const RigidMotion& motion, double resolution,
                                   long max_tests) const {
  if (!(resolution > 0.0 && resolution <= 1.0)) {
    throw InputError(
        "rigid judge: expected a resolution above 0 and at most 1, a share of "
        "the way, found " +
        Rounded(resolution));
  }
  return internal::SearchFirstHit(*impl_, Framed(*impl_, motion), resolution,
                                  max_tests);
}

RigidClearance RigidJudge::Clearance(const RigidMotion& motion,
                                     const ClearanceTolerance& tolerance,
                                     long max_tests) const {
  internal::RequireTolerance(tolerance);
  double known = internal::kInfinity;
  return ClearanceOf(*impl_, Framed(*impl_, motion), 0, tolerance, max_tests,
                     &known);
}

RigidClearance RigidJudge::Clearance(const QuaternionMotion& motion,
                                     const ClearanceTolerance& tolerance,
                                     long max_tests) const {
  internal::RequireTolerance(tolerance);
  double known = internal::kInfinity;
  return ClearanceOf(*impl_, Framed(*impl_, motion), 0, tolerance, max_tests,
                     &known);
}

// Every motion is asked for less than those before it came to only.
RigidClearance RigidJudge::PathClearance(const std::vector<RobotPose>& path,
                                         const ClearanceTolerance& tolerance,
                                         long max_tests) const {
  internal::RequireTolerance(tolerance);
  if (path.empty()) {
    throw InputError(
        "rigid judge: expected a path of at least one pose, found none");
  }
  const std::size_t motions = std::max<std::size_t>(1, path.size() - 1);
  double known = internal::kInfinity;
  RigidClearance all;
  for (std::size_t i = 0; i < motions; ++i) {
    const RigidMotion motion(path[i], path[std::min(i + 1, path.size() - 1)]);
    const double before = known;
    const RigidClearance one =
        ClearanceOf(*impl_, Framed(*impl_, motion), static_cast<int>(i),
                    tolerance, max_tests, &known);
    const double lower = i == 0 ? one.lower : std::min(all.lower, one.lower);
    const bool is_resolved = one.is_resolved && (i == 0 || all.is_resolved);
    const long tests = all.tests + one.tests;
    if (known < before) all = one;
    all.lower = lower;
    all.is_resolved = is_resolved;
    all.tests = tests;
  }
  return all;
}

}  // namespace phongpd
