// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/pose_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phongpd::internal {

int PoseTree::Add(const RobotPose& pose, int parent) {
  poses_.push_back(pose);
  parents_.push_back(parent);
  tries_.push_back(0);
  return size() - 1;
}

int PoseTree::Nearest(const RobotPose& pose) const {
  const double squared_gyration = gyration_ * gyration_;
  double best = std::numeric_limits<double>::infinity();
  int nearest = 0;
  for (int i = 0; i < size(); ++i) {
    const RobotPose& other = poses_[static_cast<std::size_t>(i)];
    const double moved = (other.position - pose.position).squaredNorm();
    if (moved >= best) continue;
    // θ = 2 arccos c, and θ² ≥ 8 (1 − c).
    const double c =
        std::min(1.0, std::abs(other.orientation.dot(pose.orientation)));
    if (moved + squared_gyration * 8.0 * (1.0 - c) >= best) continue;
    const double angle = 2.0 * std::acos(c);
    const double squared = moved + squared_gyration * angle * angle;
    if (squared < best) {
      best = squared;
      nearest = i;
    }
  }
  return nearest;
}

std::vector<RobotPose> PoseTree::WayToRoot(int node) const {
  std::vector<RobotPose> way;
  for (int i = node; i >= 0; i = parents_[static_cast<std::size_t>(i)]) {
    way.push_back(pose(i));
  }
  return way;
}

}  // namespace phongpd::internal
