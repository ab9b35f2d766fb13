// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contact/robot_pose.h"

namespace phongpd::internal {

// Poses with a free motion from each to its parent, or from that to it.
class PoseTree {
 public:
  PoseTree(const RobotPose& root, double gyration)
      : poses_{root}, parents_{-1}, tries_{0}, gyration_(gyration) {}

  int Add(const RobotPose& pose, int parent);
  // In the object norm; of several the first.  Looks at all: what it costs is
  // little beside a slide.
  int Nearest(const RobotPose& pose) const;

  const RobotPose& pose(int node) const {
    return poses_[static_cast<std::size_t>(node)];
  }
  int size() const { return static_cast<int>(poses_.size()); }
  // How often a node was drawn, which the caller counts.
  int& tries(int node) { return tries_[static_cast<std::size_t>(node)]; }

  // From the node to the root.
  std::vector<RobotPose> WayToRoot(int node) const;

 private:
  std::vector<RobotPose> poses_;
  std::vector<int> parents_, tries_;
  double gyration_;
};

}  // namespace phongpd::internal
