// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/surface_assembly.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "core/mesh/union_find.h"

namespace phongpd::internal {
namespace {

// A half-edge of the surface; `mate` is its neighbour on the same sheet.
struct SheetEdge {
  int vertex = 0;  // where it starts
  int face = 0;    // of the arrangement
  int next = 0;
  int mate = -1;
  bool sealed = false;  // stays a border although both sides are coplanar
};

class Assembler {
 public:
  Assembler(const Arrangement& arrangement, const PlaneGroups& groups,
            const AssemblyOptions& options, ExactPoints* points)
      : arrangement_(arrangement),
        groups_(groups),
        options_(options),
        points_(points) {}

  PatchSurface Run(const EdgeRings& rings, const FreeCells& cells) {
    CollectEdges(cells);
    PairEdges(rings);
    NumberVertices();
    SeparatePinchedEdges();
    assert(IsPaired());
    FormPatches();
    return Collect();
  }

 private:
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
        edges_.push_back({arrangement_.half_edges[h].from, f, 0, -1, false});
      }
    }
    for (std::size_t h = 0; h < sheet_of_.size(); ++h) {
      if (sheet_of_[h] < 0) continue;
      edges_[sheet_of_[h]].next = sheet_of_[arrangement_.half_edges[h].next];
    }
  }

  // Across the occupied sectors of every ring.
  void PairEdges(const EdgeRings& rings) {
    for (const EdgeRing& ring : rings.rings) {
      const int size = ring.end - ring.begin;
      const auto spoke = [&](int k) -> const Spoke& {
        return rings.spokes[ring.begin + k % size];
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
          throw std::logic_error("contact space: surface is not closed");
        }
        edges_[open].mate = closing;
        edges_[closing].mate = open;
      }
    }
  }

  int To(int e) const { return edges_[edges_[e].next].vertex; }

  // Has every half-edge one mate, which runs back between the same vertices?
  bool IsPaired() const {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const int mate = edges_[e].mate;
      if (mate < 0 || edges_[mate].mate != static_cast<int>(e)) return false;
      if (To(mate) != edges_[e].vertex) return false;
    }
    return true;
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

  // A point of the edge about half way: where its two planes meet a plane
  // across it.  −1 when the edge is too short for one.
  int MiddlePoint(int e, const GridPlane& other) {
    const LocatedPoint a = (*points_)[vertex_points_[edges_[e].vertex]];
    const LocatedPoint b = (*points_)[vertex_points_[To(e)]];
    const int axis =
        LargestAxis(Eigen::Vector3d(b.approximate - a.approximate));
    GridPlane across;
    across.normal[axis] = Int128(1) << 20;
    across.offset = static_cast<Int128>(
        std::ldexp(0.5 * (a.approximate[axis] + b.approximate[axis]), 20));
    if (SideOf(across, a) * SideOf(across, b) >= 0) return -1;
    PointDefinition middle;
    middle.kind = PointDefinition::kPlanes;
    middle.planes = {PlaneOf(e), other, across};
    return points_->Add(Locate(middle));
  }

  // Half-edges that two sheets of one solid share.
  void SeparatePinchedEdges() {
    using Owner = std::array<int, 3>;  // from < to, half-edge
    std::vector<Owner> owners;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const int from = edges_[e].vertex, to = To(static_cast<int>(e));
      if (from < to) owners.push_back({from, to, static_cast<int>(e)});
    }
    std::sort(owners.begin(), owners.end());
    pinned_.assign(vertex_points_.size(), 0);
    for (auto first = owners.begin(), last = first; first != owners.end();
         first = last) {
      last = std::find_if(first, owners.end(), [&](const Owner& o) {
        return o[0] != (*first)[0] || o[1] != (*first)[1];
      });
      if (last - first > 1) SeparateSheets({first, last});
    }
  }

  void SeparateSheets(const std::vector<std::array<int, 3>>& sheets) {
    const GridPlane& plane = PlaneOf(sheets[0][2]);
    const GridPlane* other = nullptr;
    for (const auto& sheet : sheets) {
      for (const int f : {sheet[2], edges_[sheet[2]].mate}) {
        if (!(PlaneOf(f) == plane)) other = &PlaneOf(f);
      }
    }
    if (other == nullptr) return;
    const int middle = MiddlePoint(sheets[0][2], *other);
    if (middle < 0) return;
    pinned_[sheets[0][0]] = pinned_[sheets[0][1]] = 1;
    for (const auto& sheet : sheets) SplitSheet(sheet[2], middle);
  }

  void SplitSheet(int e, int point) {
    const int vertex = static_cast<int>(vertex_points_.size());
    vertex_points_.push_back(point);
    pinned_.push_back(1);
    const int m = edges_[e].mate;
    const int e2 = static_cast<int>(edges_.size()), m2 = e2 + 1;
    edges_.push_back({vertex, edges_[e].face, edges_[e].next, m, true});
    edges_.push_back({vertex, edges_[m].face, edges_[m].next, e, true});
    edges_[e].next = e2;
    edges_[m].next = m2;
    edges_[e].mate = m2;
    edges_[m].mate = e2;
    edges_[e].sealed = edges_[m].sealed = true;
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
      if (options_.merge_coplanar && !e.sealed &&
          OrientedPlane(f) == OrientedPlane(g)) {
        sets.Join(f, g);
      }
    }
    is_border_.resize(edges_.size());
    patch_of_.resize(edges_.size());
    std::map<int, int> ids;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const int patch = sets.Find(edges_[e].face);
      is_border_[e] =
          edges_[e].sealed || patch != sets.Find(edges_[edges_[e].mate].face);
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
      removable[v] = removable[v] && degree[v] == 2 && !pinned_[v];
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

  // Has a patch that does not end at border edge e corners at both vertices?
  bool IsSharedByThird(const PatchCorners& corners, int e, int from,
                       int to) const {
    const auto at = [&](int v, int side) {
      return corners.patches.begin() + corners.begin[v + side];
    };
    return std::any_of(at(from, 0), at(from, 1), [&](int patch) {
      return patch != patch_of_[e] && patch != patch_of_[edges_[e].mate] &&
             std::find(at(to, 0), at(to, 1), patch) != at(to, 1);
    });
  }

  // Two sheets along one line may have different vertices on it; dropping
  // them all would leave both with the same edge, or one with an edge that is
  // a diagonal of the other's patch.  Keeps one.
  void KeepEdgesDistinct(const std::vector<std::vector<int>>& loops,
                         std::vector<char>* removable) const {
    const PatchCorners corners = CollectCorners();
    for (bool changed = true; changed;) {
      changed = false;
      std::map<std::pair<int, int>, int> dropped;  // edge → a vertex left out
      for (const std::vector<int>& loop : loops) {
        const std::size_t size = loop.size();
        const auto vertex = [&](std::size_t k) {
          return edges_[loop[k % size]].vertex;
        };
        std::size_t start = 0;
        while (start < size && (*removable)[vertex(start)]) ++start;
        for (std::size_t k = start; k < start + size;) {
          std::size_t next = k + 1;
          while (next < start + size && (*removable)[vertex(next)]) ++next;
          const int skipped = next > k + 1 ? vertex(k + 1) : -1;
          const auto [it, is_new] =
              dropped.try_emplace({vertex(k), vertex(next)}, skipped);
          const int keep = it->second >= 0 ? it->second : skipped;
          if (!is_new && keep >= 0) {
            (*removable)[keep] = 0;
            changed = true;
          } else if (skipped >= 0 && IsSharedByThird(corners, loop[k % size],
                                                     vertex(k), vertex(next))) {
            (*removable)[skipped] = 0;
            changed = true;
          }
          k = next;
        }
      }
    }
  }

  PatchSurface Collect() const {
    const std::vector<std::vector<int>> loops = BorderLoops();
    std::vector<char> removable = Removable();
    KeepEdgesDistinct(loops, &removable);
    PatchSurface out;
    out.patches.resize(patch_count_);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      out.patches[patch_of_[e]].facet =
          arrangement_.faces[edges_[e].face].facet;
    }
    std::vector<int> id_of(vertex_points_.size(), -1);
    for (const std::vector<int>& border : loops) {
      std::vector<int> loop;
      for (const int e : border) {
        const int v = edges_[e].vertex;
        if (removable[v]) continue;
        if (id_of[v] < 0) {
          id_of[v] = static_cast<int>(out.vertex_points.size());
          out.vertex_points.push_back(vertex_points_[v]);
        }
        loop.push_back(id_of[v]);
      }
      out.patches[patch_of_[border[0]]].loops.push_back(std::move(loop));
    }
    return out;
  }

  const Arrangement& arrangement_;
  const PlaneGroups& groups_;
  const AssemblyOptions& options_;
  ExactPoints* points_;
  std::vector<int> sheet_of_;  // per half-edge of the arrangement
  std::vector<SheetEdge> edges_;
  std::vector<int> vertex_points_;
  std::vector<char> pinned_;  // vertices that must stay
  std::vector<char> is_border_;
  std::vector<int> patch_of_;
  std::size_t patch_count_ = 0;
};

}  // namespace

PatchSurface AssembleSurface(const Arrangement& arrangement,
                             const PlaneGroups& groups, const EdgeRings& rings,
                             const FreeCells& cells,
                             const AssemblyOptions& options,
                             ExactPoints* points) {
  return Assembler(arrangement, groups, options, points).Run(rings, cells);
}

}  // namespace phongpd::internal
