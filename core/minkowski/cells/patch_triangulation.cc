// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/patch_triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "core/minkowski/build_limits.h"
#include "core/minkowski/cells/cells.h"

namespace phongpd::internal {
namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using NumberedVertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<int, ExactKernel>;
using MarkedFaceBase = CGAL::Constrained_triangulation_face_base_2<
    ExactKernel, CGAL::Triangulation_face_base_with_info_2<bool, ExactKernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    ExactKernel,
    CGAL::Triangulation_data_structure_2<NumberedVertexBase, MarkedFaceBase>,
    CGAL::No_constraint_intersection_tag>;

// An integer as a sum of doubles of one sign: exact, and with a tight interval.
ExactKernel::FT ToExact(const Wide& value) {
  const Wide magnitude = abs(value);
  const Wide mask = (Wide(1) << 52) - 1;
  ExactKernel::FT sum(0);
  for (int shift = 0; (magnitude >> shift) != 0; shift += 52) {
    const Wide digits = (magnitude >> shift) & mask;
    if (digits == 0) continue;
    const double part = std::ldexp(digits.convert_to<double>(), shift);
    sum += ExactKernel::FT(value < 0 ? -part : part);
  }
  return sum;
}

class PatchTriangulator {
 public:
  PatchTriangulator(const PatchSurface& surface, const Convolution& convolution,
                    const ExactPoints& points)
      : surface_(surface), convolution_(convolution), points_(points) {}

  std::vector<Triangle> Run(const PatchSurface::Patch& patch) const {
    if (patch.loops.size() == 1) {
      const std::vector<int>& loop = patch.loops[0];
      if (loop.size() == 3) return {{loop[0], loop[1], loop[2]}};
      if (loop.size() == 4) {
        const std::vector<Triangle> halves = SplitConvexQuad(patch);
        if (!halves.empty()) return halves;
      }
    }
    return Triangulate(patch);
  }

 private:
  using Edge = std::pair<int, int>;

  // The plane's dominant projection, turned so that the patch is seen from
  // outside.
  struct Projection {
    explicit Projection(const GridNormal& n) {
      const int dropped = LargestAxis(n);
      u = (dropped + 1) % 3;
      v = (dropped + 2) % 3;
      if (n[dropped] < 0) std::swap(u, v);
    }
    int u, v;
  };

  Eigen::Vector2d Flat(int vertex, const Projection& p) const {
    const Eigen::Vector3d& x = surface_.positions[vertex];
    return {x[p.u], x[p.v]};
  }

  // Along the shorter diagonal; empty unless clearly convex.
  std::vector<Triangle> SplitConvexQuad(
      const PatchSurface::Patch& patch) const {
    const std::vector<int>& l = patch.loops[0];
    const Projection projection(convolution_.facets[patch.facet].normal);
    Eigen::Vector2d p[4];
    for (int k = 0; k < 4; ++k) p[k] = Flat(l[k], projection);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d a = p[(k + 1) % 4] - p[k];
      const Eigen::Vector2d b = p[(k + 2) % 4] - p[k];
      const double area = a[0] * b[1] - a[1] * b[0];
      if (area <= 8 * kPointError * (a.lpNorm<1>() + b.lpNorm<1>())) return {};
    }
    if ((p[0] - p[2]).squaredNorm() <= (p[1] - p[3]).squaredNorm()) {
      return {{l[0], l[1], l[2]}, {l[0], l[2], l[3]}};
    }
    return {{l[1], l[2], l[3]}, {l[1], l[3], l[0]}};
  }

  ExactKernel::Point_2 Exact(int vertex, const Projection& p) const {
    const LocatedPoint point = points_[surface_.vertex_points[vertex]];
    if (point.definition.kind == PointDefinition::kVertex) {
      return {point.approximate[p.u], point.approximate[p.v]};
    }
    const Homogeneous h = Evaluate(point.definition);
    const ExactKernel::FT w = ToExact(h.w);
    return {ToExact(h.x[p.u]) / w, ToExact(h.x[p.v]) / w};
  }

  // Border edges by the points they join; a patch may touch itself in a
  // point, where it has several vertices.
  using Border = std::map<Edge, Edge>;

  std::vector<Triangle> Triangulate(const PatchSurface::Patch& patch) const {
    const Projection projection(convolution_.facets[patch.facet].normal);
    Triangulation cdt;
    std::unordered_map<int, Triangulation::Vertex_handle> handles;
    Border border;
    for (const std::vector<int>& loop : patch.loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const int v = loop[k], w = loop[(k + 1) % loop.size()];
        const int from = surface_.vertex_ranks[v];
        border[{from, surface_.vertex_ranks[w]}] = {v, w};
        if (handles.count(from)) continue;
        const auto handle = cdt.insert(Exact(v, projection));
        handle->info() = from;
        handles.emplace(from, handle);
      }
    }
    Constrain(border, handles, &cdt);
    std::vector<Triangulation::Face_handle> stack;
    const auto enter = [&stack](Triangulation::Face_handle face) {
      if (face->info()) return;
      face->info() = true;
      stack.push_back(face);
    };
    for (const auto face : cdt.all_face_handles()) face->info() = false;
    for (const auto face : cdt.finite_face_handles()) {
      for (int k = 0; k < 3; ++k) {
        if (border.count(EdgeOf(face, k))) enter(face);
      }
    }
    std::vector<Triangle> triangles;
    std::size_t border_edges = 0;
    while (!stack.empty()) {
      const auto face = stack.back();
      stack.pop_back();
      Triangle t;
      for (int k = 0; k < 3; ++k) {
        t[k] = VertexOf(face, k, border);
        if (face->is_constrained(k)) {
          border_edges += border.count(EdgeOf(face, k));
        } else if (cdt.is_infinite(face->neighbor(k))) {
          border_edges = border.size() + 1;  // leaked
        } else {
          enter(face->neighbor(k));
        }
      }
      triangles.push_back(t);
    }
    if (border_edges != border.size()) {
      throw NoArea();
    }
    return triangles;
  }

  static SurfaceError NoArea() {
    return SurfaceError("contact space: a patch border bounds no area");
  }

  // Borders neither cross nor run through a point of theirs: every edge of them
  // is one of the triangulation, or else no turn around a point would find it.
  template <typename Handles>
  static void Constrain(const Border& border, const Handles& handles,
                        Triangulation* cdt) {
    try {
      for (const auto& [points, vertices] : border) {
        if (points.first == points.second) throw NoArea();
        cdt->insert_constraint(handles.at(points.first),
                               handles.at(points.second));
      }
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      throw SurfaceError("contact space: a patch border crosses itself");
    }
    for (const auto& [points, vertices] : border) {
      if (!cdt->is_edge(handles.at(points.first), handles.at(points.second))) {
        throw NoArea();
      }
    }
  }

  // The edge opposite corner k, with the face on its left.
  static Edge EdgeOf(Triangulation::Face_handle face, int k) {
    return {face->vertex(Triangulation::ccw(k))->info(),
            face->vertex(Triangulation::cw(k))->info()};
  }

  // The vertex of a face's corner: that of the border edge met first when
  // turning clockwise around the point.
  static int VertexOf(Triangulation::Face_handle face, int k,
                      const Border& border) {
    const Triangulation::Vertex_handle point = face->vertex(k);
    while (true) {
      const int along = Triangulation::cw(k);  // the edge leaving the corner
      const auto it = border.find(EdgeOf(face, along));
      if (it != border.end()) return it->second.first;
      face = face->neighbor(along);
      k = face->index(point);
    }
  }

  const PatchSurface& surface_;
  const Convolution& convolution_;
  const ExactPoints& points_;
};

}  // namespace

ExactSurface TriangulatePatches(const PatchSurface& surface,
                                const Convolution& convolution,
                                const ExactPoints& points,
                                const BuildLimits* limits) {
  const PatchTriangulator triangulator(surface, convolution, points);
  std::vector<std::vector<Triangle>> triangles(surface.patches.size());
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t i) {
    if (limits != nullptr) limits->Check("surface");
    triangles[i] = triangulator.Run(surface.patches[i]);
  });
  ExactSurface out;
  out.vertex_points = surface.vertex_points;
  out.positions = surface.positions;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    out.triangles.insert(out.triangles.end(), triangles[i].begin(),
                         triangles[i].end());
    out.facet.insert(out.facet.end(), triangles[i].size(),
                     surface.patches[i].facet);
  }
  return out;
}

}  // namespace phongpd::internal
