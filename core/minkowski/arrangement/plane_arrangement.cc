// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/arrangement/plane_arrangement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "core/minkowski/arrangement/planar_graph.h"

namespace phongpd::internal {
namespace {

// What one plane contributes.  Ids below zero refer to new_points.
struct PlaneResult {
  std::vector<ArrangementFace> faces;  // half-edge ranges local to this plane
  std::vector<HalfEdge> half_edges;
  std::vector<LocatedPoint> new_points;
};

class PlaneArranger {
 public:
  PlaneArranger(const Convolution& convolution, const PlaneGroups& groups,
                const FacetIntersections& intersections,
                const BuildLimits& limits, const ExactPoints& points, int group)
      : convolution_(convolution),
        groups_(groups),
        ids_(intersections.point_ids),
        limits_(limits),
        points_(points),
        group_(group),
        members_(groups.members[group]),
        segments_(intersections.segments[group]) {
    for (const int f : members_) {
      int& representative = representative_[Layer(f)];
      if (representative < 0) representative = f;
    }
    CollectBoundary();
  }

  void Run(PlaneResult* result) {
    if (IsUntouched()) {
      KeepOutline(result);
    } else {
      Arrange(result);
    }
  }

 private:
  using Ends = std::pair<int, int>;
  struct Boundary {
    Coverage net{};
    GridPoint a, b;  // first < second as ids
  };

  // Orientation class: 0 along the group's normal, 1 against it.
  int Layer(int facet) const { return groups_.reversed[facet] != 0; }

  // Edges of the group's facets with the net number of facets on the left of
  // low → high, per class, seen along the group's normal.
  void CollectBoundary() {
    for (const int f : members_) {
      const int layer = Layer(f);
      const Triangle& t = convolution_.facets[f].corners;
      for (int k = 0; k < 3; ++k) {
        int a = t[k], b = t[(k + 1) % 3];
        if (layer) std::swap(a, b);
        const int direction = ids_[a] < ids_[b] ? 1 : -1;
        if (direction < 0) std::swap(a, b);
        Boundary& edge = boundary_[{ids_[a], ids_[b]}];
        edge.net[layer] += direction;
        edge.a = convolution_.points[a];
        edge.b = convolution_.points[b];
      }
    }
    for (auto it = boundary_.begin(); it != boundary_.end();) {
      it = it->second.net == Coverage{} ? boundary_.erase(it) : std::next(it);
    }
  }

  // One facet (or the two halves of a parallelogram) that nothing cuts.
  bool IsUntouched() const {
    for (const int f : members_) {
      if (convolution_.facets[f].source !=
          convolution_.facets[members_[0]].source) {
        return false;
      }
    }
    for (const PlaneSegment& s : segments_) {
      if (s.from != s.to) {
        if (boundary_.count({s.from, s.to}) == 0) return false;
      } else if (std::none_of(boundary_.begin(), boundary_.end(),
                              [&s](const auto& edge) {
                                return edge.first.first == s.from ||
                                       edge.first.second == s.from;
                              })) {
        return false;
      }
    }
    return true;
  }

  void KeepOutline(PlaneResult* result) const {
    const int layer = Layer(members_[0]);
    std::map<int, int> next;  // along the facet's own normal
    for (const auto& [ends, edge] : boundary_) {
      const bool forward = (edge.net[layer] > 0) != (layer == 1);
      next[forward ? ends.first : ends.second] =
          forward ? ends.second : ends.first;
    }
    const int count = static_cast<int>(next.size());
    int at = next.begin()->first;
    for (int k = 0; k < count; ++k) {
      result->half_edges.push_back({at, next[at], 0, (k + 1) % count});
      at = next[at];
    }
    result->faces.push_back({members_[0], false, 0, count});
  }

  void Arrange(PlaneResult* result) const {
    PlanarGraph graph(groups_.planes[group_]);
    std::unordered_map<int, int> vertex_of;
    std::vector<int> id_of;
    const auto vertex = [&](int id) {
      const auto [it, is_new] = vertex_of.emplace(id, 0);
      if (is_new) {
        it->second = graph.AddVertex(points_[id]);
        id_of.push_back(id);
      }
      return it->second;
    };
    for (const auto& [ends, edge] : boundary_) {
      graph.AddSegment(vertex(ends.first), vertex(ends.second),
                       graph.CutterAlong(edge.a, edge.b), edge.net);
    }
    for (const PlaneSegment& s : segments_) {
      if (boundary_.count({s.from, s.to})) continue;
      graph.AddSegment(vertex(s.from), vertex(s.to), groups_.planes[s.cutter],
                       Coverage{});
    }
    graph.Build(&limits_);
    for (std::size_t v = id_of.size(); v < graph.vertices().size(); ++v) {
      id_of.push_back(-1 - static_cast<int>(result->new_points.size()));
      result->new_points.push_back(graph.vertices()[v]);
    }
    for (std::size_t f = 1; f < graph.faces().size(); ++f) {
      const PlanarGraph::Face& face = graph.faces()[f];
      if (face.coverage != Coverage{}) Emit(graph, face, id_of, result);
    }
  }

  void Emit(const PlanarGraph& graph, const PlanarGraph::Face& face,
            const std::vector<int>& id_of, PlaneResult* result) const {
    const int layer = face.coverage[0] > 0 ? 0 : 1;
    // The graph's loops run in its projection; a face seen from behind runs
    // the other way round.
    const bool turned = graph.IsMirrored() != (layer == 1);
    const int index = static_cast<int>(result->faces.size());
    const int begin = static_cast<int>(result->half_edges.size());
    for (const int first : face.loops) {
      const int start = static_cast<int>(result->half_edges.size());
      int h = first;
      do {
        int from = id_of[graph.From(h)], to = id_of[graph.From(h ^ 1)];
        const int at = static_cast<int>(result->half_edges.size());
        if (turned) std::swap(from, to);
        result->half_edges.push_back(
            {from, to, index, turned ? at - 1 : at + 1});
        h = graph.Next(h);
      } while (h != first);
      if (turned) {
        result->half_edges[start].next =
            static_cast<int>(result->half_edges.size()) - 1;
      } else {
        result->half_edges.back().next = start;
      }
    }
    result->faces.push_back(
        {representative_[layer], face.coverage[0] > 0 && face.coverage[1] > 0,
         begin, static_cast<int>(result->half_edges.size())});
  }

  const Convolution& convolution_;
  const PlaneGroups& groups_;
  const std::vector<int>& ids_;
  const BuildLimits& limits_;
  const ExactPoints& points_;
  int group_;
  const std::vector<int>& members_;
  const std::vector<PlaneSegment>& segments_;
  std::map<Ends, Boundary> boundary_;
  std::array<int, 2> representative_ = {-1, -1};
};

}  // namespace

Arrangement ArrangePlanes(const Convolution& convolution,
                          const PlaneGroups& groups,
                          const FacetIntersections& intersections,
                          const BuildLimits& limits, ExactPoints* points) {
  const std::size_t count = groups.members.size();
  std::vector<PlaneResult> results(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t g) {
    limits.Check("arrangement");
    PlaneArranger(convolution, groups, intersections, limits, *points,
                  static_cast<int>(g))
        .Run(&results[g]);
  });
  Arrangement out;
  for (PlaneResult& result : results) {
    limits.Check("arrangement");
    std::vector<int> id_of(result.new_points.size());
    for (std::size_t i = 0; i < id_of.size(); ++i) {
      id_of[i] = points->Add(result.new_points[i]);
    }
    const auto global = [&](int id) { return id < 0 ? id_of[-1 - id] : id; };
    const int first_edge = static_cast<int>(out.half_edges.size());
    const int first_face = static_cast<int>(out.faces.size());
    for (const HalfEdge& h : result.half_edges) {
      out.half_edges.push_back({global(h.from), global(h.to),
                                first_face + h.face, first_edge + h.next});
    }
    for (ArrangementFace face : result.faces) {
      face.begin += first_edge;
      face.end += first_edge;
      out.faces.push_back(face);
    }
    result = {};
  }
  return out;
}

}  // namespace phongpd::internal
