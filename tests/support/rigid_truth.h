// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "constraints/rigid/rigid_motion.h"
#include "core/mesh/triangle_mesh.h"

// What the judge of rigid motions is compared with: meshes in place by another
// route than quaternions, and whether they meet there, in CGAL's exact kernel.
namespace phongpd::testing {

// A pose, by position and unit quaternion.
RobotPose PoseAt(
    const Eigen::Vector3d& position,
    const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity());

// A turn about z, of that angle.
Eigen::Quaterniond AboutZ(double angle);

// The mesh at R(t) p + q(t), in long doubles by the formula of Rodrigues.
TriangleMesh PlacedMesh(TriangleMesh mesh, const RigidMotion& motion, double t);

// Do triangle i of a and j of b share a point?  One without area shares none.
bool MeetExactly(const TriangleMesh& a, int i, const TriangleMesh& b, int j);

// Do the surfaces, every pair of triangles whose boxes meet?
bool MeetExactly(const TriangleMesh& a, const TriangleMesh& b);

// The distance of the surfaces, by edges of one against triangles of the other
// (segment_triangle_distance.h), every pair whose boxes are near enough.
double MeshDistance(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace phongpd::testing
