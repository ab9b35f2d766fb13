// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_judge.h"

#include <algorithm>
#include <utility>

#include "constraints/rigid/rigid_search.h"
#include "core/mesh/mesh_error.h"
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

}  // namespace phongpd
