// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>

#include "core/mesh/triangle_mesh.h"

// What both competitors share: meshes as Nef polyhedra.
namespace phongpd::bench {

using CompetitorKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using CompetitorPolyhedron = CGAL::Polyhedron_3<CompetitorKernel>;
using CompetitorNef = CGAL::Nef_polyhedron_3<CompetitorKernel>;

// The mesh through the builder's half-edge structure; `reflect` gives −A.
class PolyhedronWriter
    : public CGAL::Modifier_base<CompetitorPolyhedron::HalfedgeDS> {
 public:
  PolyhedronWriter(const TriangleMesh& mesh, bool reflect)
      : mesh_(mesh), sign_(reflect ? -1.0 : 1.0) {}

  void operator()(CompetitorPolyhedron::HalfedgeDS& structure) override {
    CGAL::Polyhedron_incremental_builder_3<CompetitorPolyhedron::HalfedgeDS>
        builder(structure, true);
    builder.begin_surface(mesh_.vertices.size(), mesh_.triangles.size());
    for (const Eigen::Vector3d& v : mesh_.vertices) {
      builder.add_vertex({sign_ * v.x(), sign_ * v.y(), sign_ * v.z()});
    }
    for (Triangle t : mesh_.triangles) {
      if (sign_ < 0) std::swap(t[1], t[2]);
      builder.begin_facet();
      for (const int v : t) {
        builder.add_vertex_to_facet(static_cast<std::size_t>(v));
      }
      builder.end_facet();
    }
    builder.end_surface();
  }

 private:
  const TriangleMesh& mesh_;
  double sign_;
};

inline CompetitorNef ToNef(const TriangleMesh& mesh, bool reflect) {
  PolyhedronWriter writer(mesh, reflect);
  CompetitorPolyhedron polyhedron;
  polyhedron.delegate(writer);
  return CompetitorNef(polyhedron);
}

}  // namespace phongpd::bench
