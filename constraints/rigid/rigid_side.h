// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "constraints/rigid/framed_motion.h"
#include "constraints/rigid/rigid_tree.h"
#include "core/bvh/triangle_bvh.h"
#include "core/mesh/triangle_mesh.h"

// What the judge of rigid motions knows of the robot, and of the obstacles.
namespace phongpd::internal {

// Where a triangle of all comes from.
struct RigidOrigin {
  int mesh = -1, triangle = -1;
};

// All triangles of one side, in the frame, and what can hold or be held.  Of
// triangles that are the same set of points the tree has the first.
struct RigidSide {
  RigidTree tree;
  std::vector<RigidOrigin> origins;    // by the number in the tree
  std::vector<TriangleCorners> given;  // as given, by the same
  std::vector<TriangleBvh> solids;     // those that are closed
  std::vector<Eigen::Vector3d> seeds;  // a corner of each component

  // In one of the solids; x not on a surface.
  bool Holds(const Eigen::Vector3d& x) const;
};

// Throws InputError "rigid judge: <what>, …" for meshes that cannot be judged.
void RequireRigidMeshes(const std::vector<TriangleMesh>& meshes,
                        const std::string& what);

// The frame in which both are of a size near 1, and the middle of the obstacles
// is 0.
RigidFrame RigidFrameOf(const std::vector<TriangleMesh>& robot,
                        const std::vector<TriangleMesh>& obstacles);

// The meshes as (v - center) * scale.
RigidSide MakeRigidSide(const std::vector<TriangleMesh>& meshes,
                        const Eigen::Vector3d& center, double scale);

}  // namespace phongpd::internal
