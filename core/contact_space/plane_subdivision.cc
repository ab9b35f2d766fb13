// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/plane_subdivision.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <unordered_map>

namespace phongpd::internal {
namespace {

// Number of facets of the group's own and of the opposite orientation.
using Coverage = std::array<int, 2>;

constexpr int kUnknown = std::numeric_limits<int>::min();

struct VertexInfo {
  int id = kUnknown;  // in ExactPoints, or −1 − index into new_points
};
struct FaceInfo {
  Coverage coverage{};
  bool visited = false;
};
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, ExactKernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    ExactKernel,
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, ExactKernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    ExactKernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::Exact_intersections_tag>;

// What one plane contributes; ids below zero refer to new_points.
struct PlaneResult {
  std::vector<ArrangementFacet> facets;
  std::vector<ExactPoint> new_points;
};

class PlaneSubdivider {
 public:
  PlaneSubdivider(const Convolution& convolution, const PlaneGroups& groups,
                  const FacetIntersections& intersections,
                  const ExactPoints& points, int group)
      : convolution_(convolution),
        groups_(groups),
        ids_(intersections.point_ids),
        points_(points),
        members_(groups.members[group]),
        segments_(intersections.segments[group]) {
    for (const int f : members_) {
      int& representative = representative_[IsReversed(f)];
      if (representative < 0) representative = f;
    }
    CollectBoundary();
  }

  // Nothing cuts the facets of this plane: they stay as they are.
  bool IsUntouched() const {
    for (const int f : members_) {
      if (convolution_.facets[f].source !=
          convolution_.facets[members_[0]].source) {
        return false;
      }
    }
    const auto is_corner = [&](int id) {
      for (const int f : members_) {
        for (const int v : convolution_.facets[f].corners) {
          if (ids_[v] == id) return true;
        }
      }
      return false;
    };
    for (const PointPair& s : segments_) {
      if (!is_corner(s.first) || !is_corner(s.second)) return false;
      if (s.first != s.second && boundary_.count(s) == 0) return false;
    }
    return true;
  }

  void KeepFacets(PlaneResult* result) const {
    for (const int f : members_) {
      const Triangle& t = convolution_.facets[f].corners;
      result->facets.push_back(
          {{ids_[t[0]], ids_[t[1]], ids_[t[2]]}, f, false});
    }
  }

  void Subdivide(PlaneResult* result) {
    ChooseProjection();
    Triangulate();
    NameNewVertices(result);
    const auto multiplicities = SubedgeMultiplicities();
    FloodCoverage(multiplicities);
    EmitFaces(result);
  }

 private:
  using Vertex = Triangulation::Vertex_handle;

  bool IsReversed(int facet) const { return groups_.reversed[facet] != 0; }

  // Edges of the group's facets, each with its net number of facets on the
  // left per orientation class (seen along the group's normal).
  void CollectBoundary() {
    for (const int f : members_) {
      const int layer = IsReversed(f);
      const Triangle& t = convolution_.facets[f].corners;
      for (int k = 0; k < 3; ++k) {
        int a = ids_[t[k]], b = ids_[t[(k + 1) % 3]];
        if (layer) std::swap(a, b);
        const int direction = a < b ? 1 : -1;
        boundary_[{std::min(a, b), std::max(a, b)}][layer] += direction;
      }
    }
  }

  static bool IsCancelled(const Coverage& c) { return c[0] == 0 && c[1] == 0; }

  // Drops the coordinate in which the plane varies least.
  void ChooseProjection() {
    const int f = members_[0];
    const GridNormal n = IsReversed(f) ? Negated(convolution_.facets[f].normal)
                                       : convolution_.facets[f].normal;
    dropped_ = LargestAxis(n);
    u_ = (dropped_ + 1) % 3;
    v_ = (dropped_ + 2) % 3;
    mirrored_ = n[dropped_] < 0;
  }

  Vertex Insert(int id) {
    const auto it = vertices_.find(id);
    if (it != vertices_.end()) return it->second;
    const ExactPoint& p = points_[id];
    const Vertex v =
        triangulation_.insert(ExactKernel::Point_2(p[u_], p[v_]), hint_);
    hint_ = v->face();
    v->info().id = id;
    vertices_.emplace(id, v);
    return v;
  }

  void Triangulate() {
    for (const auto& [edge, net] : boundary_) {
      if (IsCancelled(net)) continue;
      Insert(edge.first);
      Insert(edge.second);
    }
    for (const PointPair& s : segments_) {
      Insert(s.first);
      Insert(s.second);
    }
    for (const auto& [edge, net] : boundary_) {
      if (IsCancelled(net)) continue;
      triangulation_.insert_constraint(Insert(edge.first), Insert(edge.second));
    }
    for (const PointPair& s : segments_) {
      if (s.first == s.second) continue;
      triangulation_.insert_constraint(Insert(s.first), Insert(s.second));
    }
  }

  // Lifts crossings of segments back onto the plane.
  void NameNewVertices(PlaneResult* result) {
    const Triangle& t = convolution_.facets[members_[0]].corners;
    const ExactPoint& origin = points_[ids_[t[0]]];
    const auto normal = CGAL::cross_product(points_[ids_[t[1]]] - origin,
                                            points_[ids_[t[2]]] - origin);
    for (const Vertex v : triangulation_.finite_vertex_handles()) {
      if (v->info().id != kUnknown) continue;
      std::array<ExactNumber, 3> c;
      c[u_] = v->point().x();
      c[v_] = v->point().y();
      c[dropped_] = origin[dropped_] - (normal[u_] * (c[u_] - origin[u_]) +
                                        normal[v_] * (c[v_] - origin[v_])) /
                                           normal[dropped_];
      v->info().id = -1 - static_cast<int>(result->new_points.size());
      result->new_points.emplace_back(c[0], c[1], c[2]);
    }
  }

  // Boundary edges were cut by constraints: hands their multiplicity down to
  // the pieces.
  std::map<PointPair, Coverage> SubedgeMultiplicities() {
    std::map<PointPair, Coverage> pieces;
    for (const auto& [edge, net] : boundary_) {
      if (IsCancelled(net)) continue;
      Vertex at = Insert(edge.first);
      const Vertex end = Insert(edge.second);
      while (at != end) {
        Vertex next;
        Triangulation::Face_handle face;
        int index = 0;
        if (!triangulation_.includes_edge(at, end, next, face, index)) {
          throw std::logic_error(
              "contact space: a constraint is missing from its plane");
        }
        const int a = at->info().id, b = next->info().id;
        Coverage& piece = pieces[{std::min(a, b), std::max(a, b)}];
        for (int layer = 0; layer < 2; ++layer) {
          piece[layer] += a < b ? net[layer] : -net[layer];
        }
        at = next;
      }
    }
    return pieces;
  }

  // Winding numbers of both orientation classes, from infinity inwards.
  void FloodCoverage(const std::map<PointPair, Coverage>& pieces) {
    std::vector<Triangulation::Face_handle> stack = {
        triangulation_.infinite_face()};
    stack.back()->info().visited = true;
    while (!stack.empty()) {
      const auto face = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const auto next = face->neighbor(k);
        if (next->info().visited) continue;
        Coverage coverage = face->info().coverage;
        // Seen from `next`, the common edge runs from → to with next on its
        // left in the projection.
        const Vertex from = face->vertex(Triangulation::cw(k));
        const Vertex to = face->vertex(Triangulation::ccw(k));
        if (!triangulation_.is_infinite(from) &&
            !triangulation_.is_infinite(to)) {
          const int a = from->info().id, b = to->info().id;
          const auto it = pieces.find({std::min(a, b), std::max(a, b)});
          if (it != pieces.end()) {
            const int sign = ((a < b) != mirrored_) ? 1 : -1;
            for (int layer = 0; layer < 2; ++layer) {
              coverage[layer] += sign * it->second[layer];
            }
          }
        }
        next->info() = {coverage, true};
        stack.push_back(next);
      }
    }
  }

  void EmitFaces(PlaneResult* result) const {
    for (const auto face : triangulation_.finite_face_handles()) {
      const Coverage& coverage = face->info().coverage;
      if (IsCancelled(coverage)) continue;
      Triangle t;
      for (int k = 0; k < 3; ++k) t[k] = face->vertex(k)->info().id;
      if (mirrored_) std::swap(t[1], t[2]);  // now along the group's normal
      const int layer = coverage[0] > 0 ? 0 : 1;
      if (layer == 1) std::swap(t[1], t[2]);
      result->facets.push_back(
          {t, representative_[layer], coverage[0] > 0 && coverage[1] > 0});
    }
  }

  const Convolution& convolution_;
  const PlaneGroups& groups_;
  const std::vector<int>& ids_;
  const ExactPoints& points_;
  const std::vector<int>& members_;
  const std::vector<PointPair>& segments_;
  std::map<PointPair, Coverage> boundary_;
  std::array<int, 2> representative_ = {-1, -1};
  int dropped_ = 2, u_ = 0, v_ = 1;
  bool mirrored_ = false;
  Triangulation triangulation_;
  Triangulation::Face_handle hint_;
  std::unordered_map<int, Vertex> vertices_;
};

}  // namespace

std::vector<ArrangementFacet> SubdividePlanes(
    const Convolution& convolution, const PlaneGroups& groups,
    const FacetIntersections& intersections, ExactPoints* points) {
  const std::size_t count = groups.members.size();
  std::vector<PlaneResult> results(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t g) {
    PlaneSubdivider plane(convolution, groups, intersections, *points,
                          static_cast<int>(g));
    if (plane.IsUntouched()) {
      plane.KeepFacets(&results[g]);
    } else {
      plane.Subdivide(&results[g]);
    }
  });
  std::vector<ArrangementFacet> facets;
  for (PlaneResult& result : results) {
    std::vector<int> id_of(result.new_points.size());
    for (std::size_t i = 0; i < id_of.size(); ++i) {
      id_of[i] = points->Add(result.new_points[i]);
    }
    for (ArrangementFacet facet : result.facets) {
      for (int& corner : facet.corners) {
        if (corner < 0) corner = id_of[-1 - corner];
      }
      facets.push_back(facet);
    }
    result = {};
  }
  return facets;
}

}  // namespace phongpd::internal
