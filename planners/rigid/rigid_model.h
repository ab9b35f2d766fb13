// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "constraints/rigid/rigid_judge.h"
#include "core/mesh/triangle_mesh.h"
#include "planners/rigid/aligned_features.h"
#include "planners/rigid/pose_contacts.h"

namespace phongpd::internal {

// What a RigidWorld holds.
struct RigidModel {
  std::vector<TriangleMesh> robot, obstacles;
  RigidJudge judge;
  ContactSurface robot_surface, obstacle_surface;
  AlignedFeatures features;
  double gyration, reach;
  Eigen::AlignedBox3d obstacle_box;
};

}  // namespace phongpd::internal
