// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/surface_assembly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "core/mesh/union_find.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/cells/surface_order.h"

namespace phongpd::internal {
namespace {

// A half-edge of the surface; `mate` is its neighbour on the same sheet.
struct SheetEdge {
  int vertex = 0;  // where it starts
  int face = 0;    // of the arrangement
  int next = 0;
  int mate = -1;
};

// An edge of a patch's border without the vertices that were dropped from it.
struct BorderEdge {
  int from = 0, to = 0;
  int first = 0, last = 0;  // half-edges it is made of
  int middle = -1;          // a vertex put between its ends
};

class Assembler {
 public:
  Assembler(const Arrangement& arrangement, const PlaneGroups& groups,
            const AssemblyOptions& options, ExactPoints* points)
      : arrangement_(arrangement),
        groups_(groups),
        options_(options),
        points_(points) {}

  PatchSurface Run(const RadialEdges& radial, const FreeCells& cells) {
    CollectEdges(cells);
    CheckLimits();
    PairEdges(radial);
    RequirePaired();
    NumberVertices();
    CheckLimits();
    FormPatches();
    CheckLimits();
    return Collect();
  }

 private:
  void CheckLimits() const {
    if (options_.limits != nullptr) options_.limits->CheckNow("surface");
  }

  // Half-edges of all faces that separate free from occupied.
  void CollectEdges(const FreeCells& cells) {
    const std::vector<char>& wanted =
        options_.outer_only ? cells.side_is_outer : cells.side_is_free;
    sheet_of_.assign(arrangement_.half_edges.size(), -1);
    for (int f = 0; f < static_cast<int>(arrangement_.faces.size()); ++f) {
      // Only + sides can be free: behind a facet is occupied.
      if (!wanted[PlusSide(f)] || cells.side_is_free[MinusSide(f)]) continue;
      const ArrangementFace& face = arrangement_.faces[f];
      for (int h = face.begin; h < face.end; ++h) {
        sheet_of_[h] = static_cast<int>(edges_.size());
        edges_.push_back({arrangement_.half_edges[h].from, f, 0, -1});
      }
    }
    for (std::size_t h = 0; h < sheet_of_.size(); ++h) {
      if (sheet_of_[h] < 0) continue;
      edges_[sheet_of_[h]].next = sheet_of_[arrangement_.half_edges[h].next];
    }
  }

  // Across the occupied sectors of every edge.
  void PairEdges(const RadialEdges& radial) {
    for (const RadialEdge& edge : radial.edges) {
      const int size = edge.end - edge.begin;
      const auto spoke = [&](int k) -> const Spoke& {
        return radial.spokes[edge.begin + k % size];
      };
      for (int k = 0; k < size; ++k) {
        // A face that is free towards its predecessor opens an occupied
        // sector; the next face free towards its successor closes it.
        const int open = sheet_of_[spoke(k).half_edge];
        if (open < 0 || spoke(k).forward) continue;
        int closing = -1;
        for (int j = k + 1; closing < 0 && j <= k + size; ++j) {
          if (spoke(j).forward) closing = sheet_of_[spoke(j).half_edge];
        }
        if (closing < 0) {
          throw SurfaceError("contact space: surface is not closed");
        }
        edges_[open].mate = closing;
        edges_[closing].mate = open;
      }
    }
  }

  // Has every half-edge one mate?  They run between the same points, one each
  // way, as PairEdges takes them.
  void RequirePaired() const {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const int mate = edges_[e].mate;
      if (mate < 0 || edges_[mate].mate != static_cast<int>(e)) {
        throw SurfaceError("contact space: surface is not closed");
      }
    }
  }

  // Gives every fan of faces around a point a vertex of its own.
  void NumberVertices() {
    UnionFind fans(edges_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      fans.Join(static_cast<int>(e), edges_[edges_[e].mate].next);
    }
    std::vector<int> vertex_of(edges_.size(), -1);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      int& vertex = vertex_of[fans.Find(static_cast<int>(e))];
      if (vertex < 0) {
        vertex = static_cast<int>(vertex_points_.size());
        vertex_points_.push_back(edges_[e].vertex);
      }
      edges_[e].vertex = vertex;
    }
  }

  const GridPlane& PlaneOf(int e) const {
    const int facet = arrangement_.faces[edges_[e].face].facet;
    return groups_.planes[groups_.of_facet[facet]];
  }

  // Plane and orientation as one number.
  int OrientedPlane(int face) const {
    const int facet = arrangement_.faces[face].facet;
    return 2 * groups_.of_facet[facet] + groups_.reversed[facet];
  }

  void FormPatches() {
    UnionFind sets(arrangement_.faces.size());
    for (const SheetEdge& e : edges_) {
      const int f = e.face, g = edges_[e.mate].face;
      if (options_.merge_coplanar && OrientedPlane(f) == OrientedPlane(g)) {
        sets.Join(f, g);
      }
    }
    is_border_.resize(edges_.size());
    patch_of_.resize(edges_.size());
    std::map<int, int> ids;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const int patch = sets.Find(edges_[e].face);
      is_border_[e] = patch != sets.Find(edges_[edges_[e].mate].face);
      patch_of_[e] =
          ids.emplace(patch, static_cast<int>(ids.size())).first->second;
    }
    patch_count_ = ids.size();
  }

  // Border vertices between the same two planes on both sides.
  std::vector<char> Removable() const {
    std::vector<int> degree(vertex_points_.size(), 0);
    std::vector<char> removable(vertex_points_.size(), 0);
    if (!options_.merge_coplanar) return removable;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!is_border_[e]) continue;
      const int v = edges_[e].vertex;
      ++degree[v];
      removable[v] = OrientedPlane(edges_[e].face) / 2 !=
                     OrientedPlane(edges_[edges_[e].mate].face) / 2;
    }
    for (std::size_t v = 0; v < degree.size(); ++v) {
      removable[v] = removable[v] && degree[v] == 2;
    }
    return removable;
  }

  // The border loops of all patches, as half-edges.
  std::vector<std::vector<int>> BorderLoops() const {
    std::vector<std::vector<int>> loops;
    std::vector<char> visited(edges_.size(), 0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!is_border_[e] || visited[e]) continue;
      std::vector<int> loop;
      int at = static_cast<int>(e);
      do {
        visited[at] = 1;
        loop.push_back(at);
        at = edges_[at].next;
        while (!is_border_[at]) at = edges_[edges_[at].mate].next;
      } while (at != static_cast<int>(e));
      loops.push_back(std::move(loop));
    }
    return loops;
  }

  // The patches with a corner at vertex v: from patches[begin[v]] up to
  // patches[begin[v + 1]].
  struct PatchCorners {
    std::vector<int> begin, patches;
  };

  PatchCorners CollectCorners() const {
    PatchCorners corners;
    corners.begin.assign(vertex_points_.size() + 2, 0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (is_border_[e]) ++corners.begin[edges_[e].vertex + 2];
    }
    std::partial_sum(corners.begin.begin(), corners.begin.end(),
                     corners.begin.begin());
    corners.patches.resize(corners.begin.back());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!is_border_[e]) continue;
      corners.patches[corners.begin[edges_[e].vertex + 1]++] = patch_of_[e];
    }
    return corners;
  }

  // The borders over the vertices that stay.
  std::vector<std::vector<BorderEdge>> DropVertices(
      const std::vector<std::vector<int>>& loops) const {
    const std::vector<char> removable = Removable();
    std::vector<std::vector<BorderEdge>> borders;
    for (const std::vector<int>& loop : loops) {
      const std::size_t size = loop.size();
      const auto vertex = [&](std::size_t k) {
        return edges_[loop[k % size]].vertex;
      };
      std::size_t start = 0;
      while (start < size && removable[vertex(start)]) ++start;
      std::vector<BorderEdge> border;
      for (std::size_t k = start; k < start + size;) {
        std::size_t next = k + 1;
        while (next < start + size && removable[vertex(next)]) ++next;
        border.push_back({vertex(k), vertex(next), loop[k % size],
                          loop[(next - 1) % size], -1});
        k = next;
      }
      borders.push_back(std::move(border));
    }
    return borders;
  }

  // The mate of a border edge's last half-edge begins its other side: the less
  // of both is the edge's name.
  int NameOf(const BorderEdge& e) const {
    return std::min(e.first, edges_[e.last].mate);
  }

  // Has a patch that does not end at border edge e corners at both its ends?
  bool IsSharedByThird(const PatchCorners& corners, const BorderEdge& e) const {
    const auto at = [&](int v, int side) {
      return corners.patches.begin() + corners.begin[v + side];
    };
    return std::any_of(at(e.from, 0), at(e.from, 1), [&](int patch) {
      return patch != patch_of_[e.first] &&
             patch != patch_of_[edges_[e.first].mate] &&
             std::find(at(e.to, 0), at(e.to, 1), patch) != at(e.to, 1);
    });
  }

  // Where a solid touches itself two sheets may have an edge with the same
  // ends, or one has an edge that is a diagonal of another's patch.  Each such
  // edge gets a vertex of its own between its ends.
  void KeepEdgesDistinct(std::vector<std::vector<BorderEdge>>* borders) {
    const PatchCorners corners = CollectCorners();
    std::vector<const BorderEdge*> by_ends;
    for (const std::vector<BorderEdge>& border : *borders) {
      for (const BorderEdge& e : border) {
        if (e.first == NameOf(e)) by_ends.push_back(&e);
      }
    }
    const auto ends = [](const BorderEdge* e) {
      return std::minmax(e->from, e->to);
    };
    std::sort(by_ends.begin(), by_ends.end(),
              [&](const BorderEdge* a, const BorderEdge* b) {
                return ends(a) != ends(b) ? ends(a) < ends(b)
                                          : a->first < b->first;
              });
    std::map<int, int> middle_of;  // edge's name → vertex
    for (auto first = by_ends.begin(), last = first; first != by_ends.end();
         first = last) {
      while (last != by_ends.end() && ends(*last) == ends(*first)) ++last;
      if (last - first == 1 && !IsSharedByThird(corners, **first)) continue;
      const int point = MiddlePoint(first, last);
      if (point < 0) continue;
      for (auto e = first; e != last; ++e) {
        middle_of[(*e)->first] = static_cast<int>(vertex_points_.size());
        vertex_points_.push_back(point);
      }
    }
    if (middle_of.empty()) return;
    for (std::vector<BorderEdge>& border : *borders) {
      for (BorderEdge& e : border) {
        const auto it = middle_of.find(NameOf(e));
        if (it != middle_of.end()) e.middle = it->second;
      }
    }
  }

  // A point about half way between the common ends of edges: where two planes
  // that meet there meet a third one across.  −1 where there are no two, or
  // the edge is too short for one.
  int MiddlePoint(std::vector<const BorderEdge*>::const_iterator begin,
                  std::vector<const BorderEdge*>::const_iterator end) {
    const GridPlane& plane = PlaneOf((*begin)->first);
    const GridPlane* other = nullptr;
    for (auto e = begin; e != end; ++e) {
      for (const int f : {(*e)->first, edges_[(*e)->first].mate}) {
        if (!(PlaneOf(f) == plane)) other = &PlaneOf(f);
      }
    }
    if (other == nullptr) return -1;
    const LocatedPoint a = (*points_)[vertex_points_[(*begin)->from]];
    const LocatedPoint b = (*points_)[vertex_points_[(*begin)->to]];
    const int units = options_.units_per_step;
    const Eigen::Vector3d from = NearestDoubles(a.definition, units);
    const Eigen::Vector3d to = NearestDoubles(b.definition, units);
    const int axis = LargestAxis(Eigen::Vector3d(to - from));
    GridPlane across;
    across.normal[axis] = Int128(1) << 20;
    across.offset =
        static_cast<Int128>(std::ldexp(0.5 * (from[axis] + to[axis]), 20)) *
        units;
    if (SideOf(across, a) * SideOf(across, b) >= 0) return -1;
    PointDefinition middle;
    middle.kind = PointDefinition::kPlanes;
    middle.planes = {plane, *other, across};
    return points_->Add(Locate(middle));
  }

  PatchSurface Collect() {
    std::vector<std::vector<BorderEdge>> borders = DropVertices(BorderLoops());
    KeepEdgesDistinct(&borders);
    PatchSurface out;
    out.patches.resize(patch_count_);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      out.patches[patch_of_[e]].facet =
          arrangement_.faces[edges_[e].face].facet;
    }
    out.vertex_points = vertex_points_;
    for (const std::vector<BorderEdge>& border : borders) {
      std::vector<int> loop;
      for (const BorderEdge& e : border) {
        loop.push_back(e.from);
        if (e.middle >= 0) loop.push_back(e.middle);
      }
      out.patches[patch_of_[border[0].first]].loops.push_back(std::move(loop));
    }
    OrderSurface(*points_, options_.units_per_step, &out);
    return out;
  }

  const Arrangement& arrangement_;
  const PlaneGroups& groups_;
  const AssemblyOptions& options_;
  ExactPoints* points_;
  std::vector<int> sheet_of_;  // per half-edge of the arrangement
  std::vector<SheetEdge> edges_;
  std::vector<int> vertex_points_;
  std::vector<char> is_border_;
  std::vector<int> patch_of_;
  std::size_t patch_count_ = 0;
};

}  // namespace

PatchSurface AssembleSurface(const Arrangement& arrangement,
                             const PlaneGroups& groups,
                             const RadialEdges& radial, const FreeCells& cells,
                             const AssemblyOptions& options,
                             ExactPoints* points) {
  return Assembler(arrangement, groups, options, points).Run(radial, cells);
}

}  // namespace phongpd::internal
