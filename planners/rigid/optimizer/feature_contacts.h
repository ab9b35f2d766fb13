// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "planners/rigid/pose_contacts.h"

// Every place where a robot is close to obstacles, not one a pair of triangles:
// a face that lies along another is close at all of its corners.
namespace phongpd::internal {

// The corners and edges of a surface, and what is around them; corners of the
// same coordinates are one.
struct SurfaceFeatures {
  explicit SurfaceFeatures(const ContactSurface& surface);

  std::vector<Eigen::Vector3d> points;
  // Of each triangle, in the order of the surface: its corners, and its edges
  // from corner k to corner k + 1.
  std::vector<std::array<std::size_t, 3>> corners, edges;
  // Corners that share a triangle with a corner, or with an edge.
  std::vector<std::vector<std::size_t>> around_point, around_edge;
};

// Local minima of the distance between the two surfaces within `radius`, of a
// corner of one from the other, or of two edges that cross: closest points p on
// the robot and p' on the obstacle, n = (p − p')/|p − p'|, where to first order
// no way within either surface, from p or p', leads closer.  So the crease
// between two triangles of one plane is none, nor is an edge that a face is in
// front of.  Each once, the nearest first.  Clears `contacts` first; adds to
// *tests as FindContacts.  False: `stop`, which may be null, ended it, and
// `contacts` is not all of them.
class FeatureContacts {
 public:
  // The surfaces must outlive this.
  FeatureContacts(const ContactSurface& robot, const ContactSurface& obstacle)
      : robot_(robot),
        obstacle_(obstacle),
        robot_features_(robot),
        obstacle_features_(obstacle) {}

  bool Find(const RobotPose& pose, double radius,
            std::vector<PoseContact>* contacts, long* tests,
            RigidStop* stop = nullptr) const;

 private:
  const ContactSurface& robot_;
  const ContactSurface& obstacle_;
  SurfaceFeatures robot_features_, obstacle_features_;
};

}  // namespace phongpd::internal
