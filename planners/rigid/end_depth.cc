// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/end_depth.h"

#include <cstddef>

#include "core/contact/depth.h"
#include "core/mesh/mesh_error.h"

namespace phongpd::internal {
namespace {

constexpr double kDepthSeconds = 1.0;

}  // namespace

std::optional<double> DepthAtEnd(const RigidWorld& world,
                                 const RigidCheck& check,
                                 const RobotPose& pose) {
  if (check.robot_mesh < 0 || check.obstacle_mesh < 0) return std::nullopt;
  DepthOptions options;
  options.max_seconds = kDepthSeconds;
  try {
    const Depth depth = PenetrationDepth(
        world.robot()[static_cast<std::size_t>(check.robot_mesh)],
        world.obstacles()[static_cast<std::size_t>(check.obstacle_mesh)], pose,
        options);
    if (depth.certified && depth.depth > 0.0) return depth.depth;
  } catch (const InputError&) {  // no solids, or too much to build
  }
  return std::nullopt;
}

}  // namespace phongpd::internal
