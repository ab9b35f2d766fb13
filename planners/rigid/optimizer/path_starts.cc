// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/path_starts.h"

#include <cstddef>
#include <random>

#include "planners/rigid/object_norm.h"

namespace phongpd::internal {

using RigidPath = std::vector<RobotPose>;

RigidPath StraightStart(const RigidWorld& world,
                        const RigidOptimizeRequest& request,
                        const Eigen::AlignedBox3d& bounds) {
  const RigidMotion straight(request.task.start, request.task.goal);
  const double length = world.Distance(request.task.start, request.task.goal);
  std::mt19937_64 random(request.task.seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  RigidPath path = {request.task.start};
  for (int i = 1; i <= request.knots; ++i) {
    Vector6 move;
    for (double& x : move) x = request.start_noise * length * normal(random);
    const double t = static_cast<double>(i) / (request.knots + 1);
    RobotPose pose = Moved(straight.At(t), move, world.gyration());
    pose.position = pose.position.cwiseMax(bounds.min()).cwiseMin(bounds.max());
    path.push_back(pose);
  }
  path.push_back(request.task.goal);
  return path;
}

RigidPath WithKnots(RigidPath path, int knots, const RigidWorld& world) {
  while (static_cast<int>(path.size()) < knots + 2) {
    std::size_t longest = 0;
    double length = -1.0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const double d = world.Distance(path[i], path[i + 1]);
      if (d > length) longest = i, length = d;
    }
    const RobotPose middle =
        RigidMotion(path[longest], path[longest + 1]).At(0.5);
    path.insert(path.begin() + static_cast<std::ptrdiff_t>(longest) + 1,
                middle);
  }
  return path;
}

}  // namespace phongpd::internal
