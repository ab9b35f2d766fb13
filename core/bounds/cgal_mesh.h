// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstddef>

#include "core/mesh/triangle_mesh.h"

// Meshes as CGAL's algorithms take and give them.  Only for .cc files.
namespace phongpd::internal {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = CgalKernel::Point_3;
using CgalMesh = CGAL::Surface_mesh<CgalPoint>;

// Centred and scaled by a power of two to the size of one: some of CGAL's
// thresholds are absolute.
struct UnitFrame {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1.0;

  explicit UnitFrame(const TriangleMesh& mesh) {
    const BoundingBox box = ComputeBounds(mesh);
    center = box.Center();
    const double diagonal = box.Diagonal();
    if (diagonal > 0.0) scale = std::ldexp(1.0, -std::ilogb(diagonal));
  }
  CgalPoint ToCgal(const Eigen::Vector3d& v) const {
    const Eigen::Vector3d x = (v - center) * scale;
    return {x.x(), x.y(), x.z()};
  }
  Eigen::Vector3d FromCgal(const CgalPoint& p) const {
    return Eigen::Vector3d(p.x(), p.y(), p.z()) / scale + center;
  }
};

inline TriangleMesh FromCgal(const CgalMesh& in, const UnitFrame& frame) {
  TriangleMesh mesh;
  std::vector<int> index(in.num_vertices() + in.number_of_removed_vertices(),
                         -1);
  for (const CgalMesh::Vertex_index v : in.vertices()) {
    index[v] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(frame.FromCgal(in.point(v)));
  }
  for (const CgalMesh::Face_index f : in.faces()) {
    Triangle triangle;
    std::size_t k = 0;
    for (const CgalMesh::Vertex_index v :
         in.vertices_around_face(in.halfedge(f))) {
      triangle[k++] = index[v];
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace phongpd::internal
