// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/room.h"

#include <algorithm>
#include <limits>

#include "core/bvh/triangle_bvh.h"
#include "planners/world/diagnosis.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// The least of `room` and the distances from the edges of `mesh`, moved by q,
// to the surface.
double FromEdges(const TriangleMesh& mesh, const Vector3d& q,
                 const TriangleBvh& surface, double room) {
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (a > b) continue;  // an edge has two sides
      room = surface.Distance(mesh.vertices[a] + q, mesh.vertices[b] + q, room);
    }
  }
  return room;
}

double BoxGap(const BoundingBox& robot, const Vector3d& q,
              const BoundingBox& obstacle) {
  const Vector3d above = robot.min + q - obstacle.max;
  const Vector3d below = obstacle.min - robot.max - q;
  return above.cwiseMax(below).cwiseMax(0.0).norm();
}

}  // namespace

// Two surfaces that do not meet are nearest to each other at an edge of one of
// them.
double Room(const Workspace& workspace, const Vector3d& q) {
  if (!Diagnose(workspace, q).IsFree()) return 0.0;
  double room = std::numeric_limits<double>::infinity();
  const BoundingBox& bounds = workspace.bounds;
  if (!bounds.IsEmpty()) {
    room = std::min((q - bounds.min).minCoeff(), (bounds.max - q).minCoeff());
  }
  const TriangleMesh& robot = workspace.robot;
  const BoundingBox box = ComputeBounds(robot);
  const TriangleBvh robot_surface(robot);
  for (const TriangleMesh& obstacle : workspace.obstacles) {
    if (BoxGap(box, q, ComputeBounds(obstacle)) >= room) continue;
    room =
        std::min(room, (robot.vertices[0] + q - obstacle.vertices[0]).norm());
    room = FromEdges(robot, q, TriangleBvh(obstacle), room);
    room = FromEdges(obstacle, -q, robot_surface, room);
  }
  return room;
}

}  // namespace phongpd
