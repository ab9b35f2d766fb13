// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/coplanar_merge.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "core/contact_space/union_find.h"

namespace phongpd::internal {
namespace {

using Edge = std::pair<int, int>;

struct EdgeHash {
  std::size_t operator()(const Edge& e) const {
    return (static_cast<std::uint64_t>(e.first) << 32 ^
            static_cast<std::uint32_t>(e.second)) *
               0x9E3779B97F4A7C15ULL >>
           8;
  }
};

using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<int, ExactKernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<ExactKernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    ExactKernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_tag>;

struct Patch {
  std::vector<int> triangles;
  std::vector<Edge> border;  // directed, patch on the left
  std::vector<Triangle> rebuilt;
};

class PatchBuilder {
 public:
  PatchBuilder(const ExactSurface& surface, const Convolution& convolution,
               const ExactPoints& points, const std::vector<char>& keep)
      : surface_(surface),
        convolution_(convolution),
        points_(points),
        keep_(keep) {}

  // False when the patch must stay as it is.
  bool Rebuild(const Patch& patch, std::vector<Triangle>* rebuilt) const {
    std::unordered_map<int, int> next;
    for (const Edge& e : patch.border) {
      if (!next.emplace(e).second) return false;  // pinched at a vertex
    }
    const std::vector<Edge> outline = SimplifiedOutline(patch, next);
    if (outline.empty()) return false;

    const GridNormal& n =
        convolution_.facets[surface_.facet[patch.triangles[0]]].normal;
    const int dropped = LargestAxis(n);
    const int u = (dropped + 1) % 3, v = (dropped + 2) % 3;
    const bool mirrored = n[dropped] < 0;

    Triangulation cdt;
    std::unordered_map<int, Triangulation::Vertex_handle> handles;
    for (const Edge& e : outline) {
      const ExactPoint& p = points_[surface_.vertex_points[e.first]];
      const std::size_t before = cdt.number_of_vertices();
      const auto handle = cdt.insert(ExactKernel::Point_2(p[u], p[v]));
      if (cdt.number_of_vertices() == before) return false;  // coincident
      handle->info() = e.first;
      handles[e.first] = handle;
    }
    // The mid-point of a pinched edge may lie inside a patch.
    for (const int t : patch.triangles) {
      for (const int w : surface_.triangles[t]) {
        if (!surface_.pinned[w] || handles.count(w)) continue;
        const ExactPoint& p = points_[surface_.vertex_points[w]];
        const auto handle = cdt.insert(ExactKernel::Point_2(p[u], p[v]));
        handle->info() = w;
        handles[w] = handle;
      }
    }
    try {
      for (const Edge& e : outline) {
        cdt.insert_constraint(handles.at(e.first), handles.at(e.second));
      }
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      return false;
    }
    return CollectInside(cdt, outline, mirrored, rebuilt);
  }

 private:
  // Border loops without the vertices that may go, as directed edges; empty
  // when a loop is not simple or shrinks below a triangle.
  std::vector<Edge> SimplifiedOutline(
      const Patch& patch, const std::unordered_map<int, int>& next) const {
    std::vector<Edge> outline;
    std::unordered_map<int, char> visited;
    for (const Edge& first : patch.border) {
      if (visited[first.first]) continue;
      std::vector<int> loop;
      int at = first.first;
      while (!visited[at]) {
        visited[at] = 1;
        if (keep_[at]) loop.push_back(at);
        const auto it = next.find(at);
        if (it == next.end()) return {};
        at = it->second;
      }
      if (at != first.first || loop.size() < 3) return {};
      for (std::size_t k = 0; k < loop.size(); ++k) {
        outline.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
      }
    }
    return outline;
  }

  // The faces left of the outline, checked to be exactly bounded by it.
  static bool CollectInside(const Triangulation& cdt,
                            const std::vector<Edge>& outline, bool mirrored,
                            std::vector<Triangle>* rebuilt) {
    std::unordered_map<Edge, char, EdgeHash> border;
    for (const Edge& e : outline) {
      border[mirrored ? Edge(e.second, e.first) : e] = 1;
    }
    std::map<Triangulation::Face_handle, char> inside;
    std::vector<Triangulation::Face_handle> stack;
    for (const auto face : cdt.finite_face_handles()) {
      for (int k = 0; k < 3; ++k) {
        const Edge e(face->vertex(Triangulation::ccw(k))->info(),
                     face->vertex(Triangulation::cw(k))->info());
        if (border.count(e) && !inside[face]) {
          inside[face] = 1;
          stack.push_back(face);
        }
      }
    }
    while (!stack.empty()) {
      const auto face = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        if (face->is_constrained(k)) continue;
        const auto neighbor = face->neighbor(k);
        if (cdt.is_infinite(neighbor)) return false;
        if (!inside[neighbor]) {
          inside[neighbor] = 1;
          stack.push_back(neighbor);
        }
      }
    }
    std::size_t border_edges = 0;
    for (const auto face : cdt.finite_face_handles()) {
      const auto it = inside.find(face);
      if (it == inside.end() || !it->second) continue;
      Triangle t = {face->vertex(0)->info(), face->vertex(1)->info(),
                    face->vertex(2)->info()};
      for (int k = 0; k < 3; ++k) {
        if (!face->is_constrained(k)) continue;
        const Edge e(face->vertex(Triangulation::ccw(k))->info(),
                     face->vertex(Triangulation::cw(k))->info());
        if (!border.count(e)) return false;  // leaked across the outline
        ++border_edges;
      }
      if (mirrored) std::swap(t[1], t[2]);
      rebuilt->push_back(t);
    }
    return border_edges == outline.size();
  }

  const ExactSurface& surface_;
  const Convolution& convolution_;
  const ExactPoints& points_;
  const std::vector<char>& keep_;
};

class Merger {
 public:
  Merger(const ExactSurface& surface, const Convolution& convolution,
         const PlaneGroups& groups, const ExactPoints& points)
      : surface_(surface),
        convolution_(convolution),
        groups_(groups),
        points_(points) {}

  ExactSurface Run() {
    FormPatches();
    MarkRemovable();
    // A failing patch pins its vertices, which may change its neighbours.
    while (RebuildAll()) {
    }
    return Collect();
  }

 private:
  bool Coplanar(int t, int u) const {
    const int f = surface_.facet[t], g = surface_.facet[u];
    return groups_.of_facet[f] == groups_.of_facet[g] &&
           groups_.reversed[f] == groups_.reversed[g];
  }

  void FormPatches() {
    const int count = static_cast<int>(surface_.triangles.size());
    std::unordered_map<Edge, int, EdgeHash> owner;
    owner.reserve(3 * surface_.triangles.size());
    for (int t = 0; t < count; ++t) {
      const Triangle& c = surface_.triangles[t];
      for (int k = 0; k < 3; ++k) owner[{c[k], c[(k + 1) % 3]}] = t;
    }
    UnionFind sets(surface_.triangles.size());
    for (const auto& [edge, t] : owner) {
      const int u = owner.at({edge.second, edge.first});
      if (Coplanar(t, u)) sets.Join(t, u);
    }
    std::vector<int> patch_of(surface_.triangles.size(), -1);
    for (int t = 0; t < count; ++t) {
      int& id = patch_of[sets.Find(t)];
      if (id < 0) {
        id = static_cast<int>(patches_.size());
        patches_.emplace_back();
      }
      patch_of[t] = id;
      patches_[id].triangles.push_back(t);
    }
    for (int t = 0; t < count; ++t) {
      const Triangle& c = surface_.triangles[t];
      for (int k = 0; k < 3; ++k) {
        const Edge e(c[k], c[(k + 1) % 3]);
        const int u = owner.at({e.second, e.first});
        if (patch_of[u] != patch_of[t])
          patches_[patch_of[t]].border.push_back(e);
      }
    }
  }

  // A border vertex may go when it lies exactly on the straight line between
  // its only two border neighbours.
  void MarkRemovable() {
    const std::size_t count = surface_.vertex_points.size();
    std::vector<std::vector<int>> neighbors(count);
    for (const Patch& patch : patches_) {
      for (const Edge& e : patch.border) {
        for (const auto& [v, w] : {e, Edge(e.second, e.first)}) {
          auto& list = neighbors[v];
          if (std::find(list.begin(), list.end(), w) == list.end()) {
            list.push_back(w);
          }
        }
      }
    }
    keep_.assign(count, 1);
    on_border_.assign(count, 0);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t v) {
      on_border_[v] = !neighbors[v].empty();
      if (neighbors[v].size() != 2 || surface_.pinned[v]) return;
      const auto point = [&](int w) -> const ExactPoint& {
        return points_[surface_.vertex_points[w]];
      };
      keep_[v] =
          !CGAL::collinear(point(neighbors[v][0]), point(static_cast<int>(v)),
                           point(neighbors[v][1]));
    });
  }

  bool NeedsRebuild(const Patch& patch) const {
    if (patch.triangles.size() == 1) return false;
    for (const Edge& e : patch.border) {
      if (!keep_[e.first]) return true;
    }
    for (const int t : patch.triangles) {
      for (const int v : surface_.triangles[t]) {
        if (!on_border_[v]) return true;
      }
    }
    return false;
  }

  // True when another round is needed.
  bool RebuildAll() {
    const PatchBuilder builder(surface_, convolution_, points_, keep_);
    std::vector<char> failed(patches_.size(), 0);
    tbb::parallel_for(std::size_t{0}, patches_.size(), [&](std::size_t i) {
      Patch& patch = patches_[i];
      patch.rebuilt.clear();
      if (!NeedsRebuild(patch)) return;
      std::vector<Triangle> rebuilt;
      if (builder.Rebuild(patch, &rebuilt)) {
        patch.rebuilt = std::move(rebuilt);
      } else {
        failed[i] = 1;
      }
    });
    bool pinned = false;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      // A single triangle whose neighbour would drop one of its corners.
      const bool single = patches_[i].triangles.size() == 1;
      if (!failed[i] && !single) continue;
      for (const Edge& e : patches_[i].border) {
        if (!keep_[e.first]) {
          keep_[e.first] = 1;
          pinned = true;
        }
      }
    }
    return pinned;
  }

  ExactSurface Collect() const {
    ExactSurface out;
    std::vector<int> vertex_of(surface_.vertex_points.size(), -1);
    const auto add = [&](Triangle t, int facet) {
      for (int& v : t) {
        int& id = vertex_of[v];
        if (id < 0) {
          id = static_cast<int>(out.vertex_points.size());
          out.vertex_points.push_back(surface_.vertex_points[v]);
          out.pinned.push_back(surface_.pinned[v]);
        }
        v = id;
      }
      out.triangles.push_back(t);
      out.facet.push_back(facet);
    };
    for (const Patch& patch : patches_) {
      const int facet = surface_.facet[patch.triangles[0]];
      if (patch.rebuilt.empty()) {
        for (const int t : patch.triangles) {
          add(surface_.triangles[t], surface_.facet[t]);
        }
      } else {
        for (const Triangle& t : patch.rebuilt) add(t, facet);
      }
    }
    return out;
  }

  const ExactSurface& surface_;
  const Convolution& convolution_;
  const PlaneGroups& groups_;
  const ExactPoints& points_;
  std::vector<Patch> patches_;
  std::vector<char> keep_;
  std::vector<char> on_border_;
};

}  // namespace

ExactSurface MergeCoplanar(const ExactSurface& surface,
                           const Convolution& convolution,
                           const PlaneGroups& groups,
                           const ExactPoints& points) {
  return Merger(surface, convolution, groups, points).Run();
}

}  // namespace phongpd::internal
