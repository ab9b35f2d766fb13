// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>

#include <utility>
#include <vector>

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

// The solid, component by component: Nef polyhedra take every bounded region
// of a surface as filled, cavities included.
inline CompetitorNef ToNef(const TriangleMesh& mesh, bool reflect) {
  int count = 0;
  const std::vector<int> label = LabelComponents(mesh, &count);
  CompetitorNef solid(CompetitorNef::EMPTY), cavities(CompetitorNef::EMPTY);
  for (int c = 0; c < count; ++c) {
    TriangleMesh part;
    std::vector<int> index(mesh.vertices.size(), -1);
    for (std::size_t t = 0; t < label.size(); ++t) {
      if (label[t] != c) continue;
      Triangle triangle = mesh.triangles[t];
      for (int& v : triangle) {
        int& i = index[static_cast<std::size_t>(v)];
        if (i < 0) {
          i = static_cast<int>(part.vertices.size());
          part.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
        }
        v = i;
      }
      part.triangles.push_back(triangle);
    }
    const bool is_cavity = SignedVolume(part) < 0.0;
    if (is_cavity) {
      for (Triangle& t : part.triangles) std::swap(t[1], t[2]);
    }
    PolyhedronWriter writer(part, reflect);
    CompetitorPolyhedron polyhedron;
    polyhedron.delegate(writer);
    (is_cavity ? cavities : solid) += CompetitorNef(polyhedron);
  }
  return cavities.is_empty() ? solid : solid - cavities;
}

}  // namespace phongpd::bench
