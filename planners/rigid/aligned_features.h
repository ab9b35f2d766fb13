// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "core/contact/robot_pose.h"
#include "core/mesh/triangle_mesh.h"

// Poses at which edges and faces of robot and obstacles lie along each other.
// Random orientations hit those that a tight hole wants with probability zero.
namespace phongpd::internal {

// An edge between two faces that are not in one plane, or a border, with one
// face at it.
struct EdgeFeature {
  Eigen::Vector3d start, end;
  Eigen::Vector3d along, normal;  // unit, at right angles
};

class AlignedFeatures {
 public:
  // Meshes that the judge takes; triangles without area have no features.
  AlignedFeatures(const std::vector<TriangleMesh>& robot,
                  const std::vector<TriangleMesh>& obstacles);

  bool IsEmpty() const { return robot_.empty() || obstacles_.empty(); }

  // A pose with an edge and a face of the robot along an edge and a face of an
  // obstacle, or against them, and an end of the one on an end of the other;
  // *along is the direction of both edges.  Not IsEmpty().
  RobotPose Draw(std::mt19937_64* random, Eigen::Vector3d* along) const;

 private:
  std::vector<EdgeFeature> robot_, obstacles_;
};

}  // namespace phongpd::internal
