// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/gyration.h"

#include <Eigen/Geometry>
#include <cmath>

namespace phongpd::internal {

// ∫ |p|² dA of a triangle is its area times the mean of |p|² at the middles of
// its edges.
double RadiusOfGyration(const std::vector<TriangleMesh>& meshes) {
  double sum = 0.0, areas = 0.0;
  for (const TriangleMesh& mesh : meshes) {
    for (const Triangle& t : mesh.triangles) {
      const Eigen::Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
      const Eigen::Vector3d& b = mesh.vertices[static_cast<std::size_t>(t[1])];
      const Eigen::Vector3d& c = mesh.vertices[static_cast<std::size_t>(t[2])];
      const double area = (b - a).cross(c - a).norm();
      sum += area *
             ((a + b).squaredNorm() + (b + c).squaredNorm() +
              (c + a).squaredNorm()) /
             12.0;
      areas += area;
    }
  }
  return areas > 0.0 ? std::sqrt(sum / areas) : 0.0;
}

}  // namespace phongpd::internal
