// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/alpha_wrap.h"

#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <cstddef>
#include <vector>

#include "core/bounds/cgal_mesh.h"
#include "core/solid/self_intersection.h"

namespace phongpd::internal {

TriangleMesh WrapTriangles(const TriangleMesh& mesh, double alpha,
                           double offset) {
  const UnitFrame frame(mesh);
  std::vector<CgalPoint> points;
  points.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& v : mesh.vertices) {
    points.push_back(frame.ToCgal(v));
  }
  std::vector<std::array<std::size_t, 3>> faces;
  for (const Triangle& t : mesh.triangles) {
    if (IsDegenerate(mesh, t)) continue;
    faces.push_back({static_cast<std::size_t>(t[0]),
                     static_cast<std::size_t>(t[1]),
                     static_cast<std::size_t>(t[2])});
  }
  CgalMesh wrap;
  CGAL::alpha_wrap_3(points, faces, alpha * frame.scale, offset * frame.scale,
                     wrap);
  return FromCgal(wrap, frame);
}

}  // namespace phongpd::internal
