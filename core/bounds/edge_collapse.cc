// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/edge_collapse.h"

#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <array>
#include <numeric>
#include <utility>

#include "core/bounds/cgal_mesh.h"

namespace phongpd::internal {
namespace {

namespace SMS = CGAL::Surface_mesh_simplification;

// The mesh with used vertices only, one for every fan of triangles.
TriangleMesh WithOneFanPerVertex(const TriangleMesh& mesh) {
  const std::vector<std::array<int, 3>> neighbors = TriangleNeighbors(mesh);
  TriangleMesh out;
  out.triangles.assign(mesh.triangles.size(), Triangle{-1, -1, -1});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (out.triangles[t][k] >= 0) continue;
      const int v = mesh.triangles[t][k];
      const int id = static_cast<int>(out.vertices.size());
      out.vertices.push_back(mesh.vertices[v]);
      // Around v, from triangle to triangle across the edge that starts at v.
      for (int f = static_cast<int>(t), corner = k;
           out.triangles[f][corner] < 0;) {
        out.triangles[f][corner] = id;
        f = neighbors[f][corner];
        const Triangle& next = mesh.triangles[f];
        corner = next[0] == v ? 0 : next[1] == v ? 1 : 2;
      }
    }
  }
  return out;
}

struct Recorder : SMS::Edge_collapse_visitor_base<CgalMesh> {
  struct Step {
    int a, b, kept;
    CgalPoint position;
  };
  std::vector<Step>* steps = nullptr;

  void OnCollapsing(const Profile& profile,
                    const boost::optional<CgalPoint>& placement) {
    if (!placement) return;
    steps->push_back({static_cast<int>(profile.v0().idx()),
                      static_cast<int>(profile.v1().idx()), -1, *placement});
  }
  void OnCollapsed(const Profile&, const vertex_descriptor& kept) {
    steps->back().kept = static_cast<int>(kept.idx());
  }
};

}  // namespace

CollapseSequence::CollapseSequence(const TriangleMesh& mesh, std::size_t target)
    : original_(WithOneFanPerVertex(mesh)) {
  const UnitFrame frame(original_);
  CgalMesh surface;
  for (const Eigen::Vector3d& v : original_.vertices) {
    surface.add_vertex(frame.ToCgal(v));
  }
  using Vertex = CgalMesh::Vertex_index;
  const auto vertex = [](int v) {
    return Vertex(static_cast<CgalMesh::size_type>(v));
  };
  for (const Triangle& t : original_.triangles) {
    if (surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) ==
        CgalMesh::null_face()) {
      return;  // an empty sequence: nothing can be collapsed
    }
  }
  std::vector<Recorder::Step> steps;
  Recorder recorder;
  recorder.steps = &steps;
  const SMS::Bounded_normal_change_placement<
      SMS::LindstromTurk_placement<CgalMesh>>
      placement;
  SMS::edge_collapse(
      surface, SMS::Count_stop_predicate<CgalMesh>(target * 3 / 2 + 1),
      CGAL::parameters::get_cost(SMS::LindstromTurk_cost<CgalMesh>())
          .get_placement(placement)
          .visitor(recorder));
  for (const Recorder::Step& step : steps) {
    if (step.kept < 0) break;
    steps_.push_back({step.kept == step.a ? step.b : step.a, step.kept,
                      frame.FromCgal(step.position)});
  }
}

TriangleMesh CollapseSequence::After(std::size_t steps) const {
  std::vector<int> root(original_.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  std::vector<Eigen::Vector3d> position = original_.vertices;
  for (std::size_t i = 0; i < steps; ++i) {
    root[steps_[i].removed] = steps_[i].kept;
    position[steps_[i].kept] = steps_[i].position;
  }
  const auto find = [&root](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  TriangleMesh mesh;
  std::vector<int> index(root.size(), -1);
  for (const Triangle& t : original_.triangles) {
    Triangle image;
    for (std::size_t k = 0; k < 3; ++k) image[k] = find(t[k]);
    if (image[0] == image[1] || image[1] == image[2] || image[2] == image[0]) {
      continue;
    }
    for (int& v : image) {
      if (index[v] < 0) {
        index[v] = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(position[v]);
      }
      v = index[v];
    }
    mesh.triangles.push_back(image);
  }
  return mesh;
}

}  // namespace phongpd::internal
