// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/stl/pair.h>
#include <nanobind/stl/vector.h>

#include <utility>
#include <vector>

#include "constraints/rigid/rigid_clearance.h"
#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"
#include "python/src/arrays.h"

// Meshes and poses of what turns, as Python hands them over.
namespace phongpd::python {

using Meshes = std::vector<std::pair<Rows3, Corners>>;
// Matrices, rows first.
using Poses = nb::ndarray<const double, nb::shape<-1, 4, 4>, nb::c_contig,
                          nb::device::cpu>;

inline std::vector<TriangleMesh> ToMeshes(const Meshes& arrays) {
  std::vector<TriangleMesh> meshes;
  for (const auto& [vertices, triangles] : arrays) {
    TriangleMesh mesh;
    mesh.vertices = ToPoints(vertices);
    for (size_t i = 0; i < triangles.shape(0); ++i) {
      mesh.triangles.push_back(
          {triangles(i, 0), triangles(i, 1), triangles(i, 2)});
    }
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

inline Eigen::Isometry3d ToMatrix(const Poses& poses, size_t i) {
  Eigen::Isometry3d matrix = Eigen::Isometry3d::Identity();
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 4; ++column) {
      matrix.matrix()(static_cast<Eigen::Index>(row),
                      static_cast<Eigen::Index>(column)) =
          poses(i, row, column);
    }
  }
  return matrix;
}

// x, y, z, w, x, y, z of each.
inline nb::list PoseRows(const std::vector<RobotPose>& poses) {
  nb::list rows;
  for (const RobotPose& pose : poses) {
    const Eigen::Vector3d& p = pose.position;
    const Eigen::Quaterniond& q = pose.orientation;
    rows.append(
        nb::make_tuple(p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()));
  }
  return rows;
}

// lower, upper, time, motion, triangles, is it resolved, tests.
inline nb::tuple ClearanceRow(const RigidClearance& found) {
  return nb::make_tuple(
      found.lower, found.upper, found.time, found.motion,
      nb::make_tuple(found.robot_mesh, found.robot_triangle),
      nb::make_tuple(found.obstacle_mesh, found.obstacle_triangle),
      found.is_resolved, found.tests);
}

}  // namespace phongpd::python
