// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/turning_removal.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "planners/rigid/rigid_plan.h"

namespace phongpd::internal {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

// Beside the rest there is as much room as this share of the part's reach.
constexpr double kRoom = 0.1;

AlignedBox3d BoxOf(const TriangleMesh& mesh, const RobotPose& pose) {
  AlignedBox3d box;
  for (const Vector3d& v : mesh.vertices) {
    box.extend(pose.orientation * v + pose.position);
  }
  return box;
}

// The nearest place at which the part is beside the box however it is turned.
RobotPose PlaceBeside(const AlignedBox3d& box, const RobotPose& start,
                      double reach) {
  RobotPose best = start;
  double least = std::numeric_limits<double>::infinity();
  const double away = (1.0 + kRoom) * reach;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double end : {box.max()[axis] + away, box.min()[axis] - away}) {
      const double far = std::abs(end - start.position[axis]);
      if (far >= least) continue;
      least = far;
      best = start;
      best.position[axis] = end;
    }
  }
  return best;
}

}  // namespace

void RemoveByTurning(const Solid& part, const std::vector<Solid>& rest,
                     double seconds, Removal* removal) {
  // About the middle of the part, wherever the assembly's origin is: a turn
  // about what is far away is no small motion.
  const Vector3d pivot = ComputeBounds(part).Center();
  const TriangleMesh robot = Translated(part.mesh(), -pivot);
  std::vector<TriangleMesh> others(rest.begin(), rest.end());
  const RigidWorld world({robot}, others);
  RigidRequest request;
  request.start.position = pivot;
  request.goal =
      PlaceBeside(world.obstacle_box(), request.start, world.reach());
  request.time_limit = seconds;
  RigidAnswer answer = Plan(world, request);
  removal->status = answer.status;
  removal->reason.clear();
  if (!answer.IsSolved()) {
    removal->reason =
        "no translation takes it out, proved; with turns " + answer.reason;
    return;
  }
  // As far as it takes to be beside the rest on any side.
  std::size_t last = 0;
  while (last + 1 < answer.path.size() &&
         world.obstacle_box().intersects(BoxOf(robot, answer.path[last]))) {
    ++last;
  }
  answer.path.resize(last + 1);
  removal->length = 0.0;
  for (std::size_t i = 0; i < last; ++i) {
    removal->length += world.Distance(answer.path[i], answer.path[i + 1]);
  }
  removal->poses = std::move(answer.path);
  removal->pivot = pivot;
}

}  // namespace phongpd::internal
