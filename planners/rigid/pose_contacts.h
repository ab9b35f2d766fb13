// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/bvh/triangle_corners.h"
#include "core/contact/robot_pose.h"
#include "core/mesh/triangle_mesh.h"
#include "planners/rigid/rigid_links.h"

// Where a robot at a pose is close to obstacles.
namespace phongpd::internal {

// All triangles of one side, in its own frame, each once though it be stored
// twice.
struct ContactSurface {
  // Finite meshes, one triangle at least.
  explicit ContactSurface(const std::vector<TriangleMesh>& meshes);

  std::vector<TriangleCorners> corners;  // in the order of the tree
  BoxTree tree;
};

// Calls visit(i, j, placed) for all pairs of triangles, numbers in the order of
// the trees, but such as boxes or a plane of one of them show to be farther
// apart than radius; `placed` is the robot's, at the pose.  Adds the pairs of
// boxes and triangles looked at to *tests.  `stop`, if there is one, is asked
// now and then, as fine surfaces have many millions of pairs; false: it ended
// this before all were visited.
using VisitTriangles =
    std::function<void(std::size_t, std::size_t, const TriangleCorners&)>;
bool ForEachClosePair(const ContactSurface& robot,
                      const ContactSurface& obstacle, const RobotPose& pose,
                      double radius, const VisitTriangles& visit, long* tests,
                      RigidStop* stop = nullptr);

// The closest points of a triangle of the robot and one of the obstacles.  A
// small motion (v, ω) changes the gap by n · v + (r × n) · ω.
struct PoseContact {
  Eigen::Vector3d normal;  // n, unit, from the obstacle to the robot
  Eigen::Vector3d arm;     // r, of the robot's point from the robot's origin
  double gap = 0.0;        // > 0, to rounding
};

inline bool IsNearer(const PoseContact& a, const PoseContact& b) {
  return a.gap < b.gap;
}

// All pairs of triangles with a gap ≤ radius, in the order of the trees; such
// as meet have no direction and are left out.  If these are more than `most`,
// which is 1 at least, the nearest so many, in any order.  Clears `contacts`
// first; adds the pairs of boxes and triangles looked at to *tests.
void FindContacts(const ContactSurface& robot, const ContactSurface& obstacle,
                  const RobotPose& pose, double radius,
                  std::vector<PoseContact>* contacts, long* tests,
                  std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace phongpd::internal
