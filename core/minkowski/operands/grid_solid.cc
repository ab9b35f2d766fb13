// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/grid_solid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "core/mesh/edge_sides.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/union_find.h"
#include "core/minkowski/operands/grid_repair.h"

namespace phongpd::internal {
namespace {

using EdgeEnds = std::pair<int, int>;

GridNormal FacetNormal(const std::vector<GridPoint>& vertices,
                       const Triangle& t) {
  return Cross(vertices[t[1]] - vertices[t[0]],
               vertices[t[2]] - vertices[t[0]]);
}

// Joins the ends of edges whose ends fell onto one grid point, the lower index
// staying, and drops the facets that collapse with them; appends these to
// *lost.
void JoinCoincidentEnds(std::vector<Triangle>* facets,
                        const std::vector<GridPoint>& vertices,
                        std::vector<Triangle>* lost) {
  UnionFind ends(vertices.size());
  for (const Triangle& t : *facets) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (vertices[a] == vertices[b]) ends.Join(a, b);
    }
  }
  std::vector<Triangle> kept;
  kept.reserve(facets->size());
  for (const Triangle& t : *facets) {
    const Triangle u = {ends.Find(t[0]), ends.Find(t[1]), ends.Find(t[2])};
    const bool is_collapsed = u[0] == u[1] || u[1] == u[2] || u[2] == u[0];
    (is_collapsed ? *lost : kept).push_back(u);
  }
  *facets = std::move(kept);
}

// Gives the middle corner of every collinear facet to the neighbour across its
// longest edge: (a,b,c) with b between a and c, and (a,c,d), become (a,b,d)
// and (b,c,d).  The surface stays the same point set, but for flat pockets
// without an edge to anything else, which are appended to *lost.
class CollinearDissolver {
 public:
  CollinearDissolver(std::vector<Triangle>* facets,
                     const std::vector<GridPoint>& vertices,
                     const std::string& name, std::vector<Triangle>* lost)
      : facets_(*facets), vertices_(vertices), name_(name), lost_(*lost) {}

  void DissolveFacets() {
    if (std::none_of(facets_.begin(), facets_.end(),
                     [this](const Triangle& t) { return IsFlat(t); })) {
      return;
    }
    alive_.assign(facets_.size(), 1);
    for (int f = 0; f < FacetCount(); ++f) AttachFacet(f);
    // Each step moves one corner off a flat facet; the bound only guards
    // against an operand that is nothing but flat facets.
    for (std::size_t steps = 0; !queue_.empty(); ++steps) {
      const int f = queue_.back();
      queue_.pop_back();
      if (!alive_[f] || !IsFlat(facets_[f])) continue;
      if (steps > 16 * facets_.size()) {
        throw InputError(name_ +
                         ": expected facets with area, found a chain of "
                         "zero-area triangles that cannot be dissolved; remesh "
                         "the operand");
      }
      MoveMiddleCorner(f);
    }
    DropDissolved();
  }

 private:
  int FacetCount() const { return static_cast<int>(facets_.size()); }

  bool IsFlat(const Triangle& t) const {
    return IsZero(FacetNormal(vertices_, t));
  }

  // Makes facet f the owner of its edges; a flat one is to be dissolved.
  void AttachFacet(int f) {
    const Triangle& t = facets_[f];
    for (int k = 0; k < 3; ++k) {
      owner_.emplace(EdgeEnds(t[k], t[(k + 1) % 3]), f);
    }
    if (IsFlat(t)) queue_.push_back(f);
  }

  void DetachFacet(int f) {
    const Triangle& t = facets_[f];
    for (int k = 0; k < 3; ++k) {
      auto range = owner_.equal_range(EdgeEnds(t[k], t[(k + 1) % 3]));
      for (auto it = range.first; it != range.second; ++it) {
        if (it->second == f) {
          owner_.erase(it);
          break;
        }
      }
    }
  }

  int LongestEdge(const Triangle& t) const {
    const auto length = [&](int k) {
      return ToDouble(vertices_[t[(k + 1) % 3]] - vertices_[t[k]])
          .squaredNorm();
    };
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (length(k) > length(longest)) longest = k;
    }
    return longest;
  }

  int OwnerOf(int a, int c) const {
    const auto it = owner_.find(EdgeEnds(a, c));
    if (it == owner_.end()) {
      throw InputError(name_ +
                       ": expected a closed mesh, found a boundary edge "
                       "beside a zero-area triangle");
    }
    return it->second;
  }

  void MoveMiddleCorner(int f) {
    const Triangle t = facets_[f];
    const int longest = LongestEdge(t);
    const int c = t[longest], a = t[(longest + 1) % 3];
    const int b = t[(longest + 2) % 3];
    const int g = OwnerOf(a, c);
    const Triangle& n = facets_[g];
    const int d = n[0] != a && n[0] != c   ? n[0]
                  : n[1] != a && n[1] != c ? n[1]
                                           : n[2];
    DetachFacet(f);
    DetachFacet(g);
    if (d == b) {  // The pair is a flat pocket: it vanishes.
      alive_[f] = alive_[g] = 0;
      lost_.push_back(t);
      return;
    }
    facets_[f] = {a, b, d};
    facets_[g] = {b, c, d};
    for (const int h : {f, g}) AttachFacet(h);
  }

  void DropDissolved() {
    std::vector<Triangle> kept;
    for (int f = 0; f < FacetCount(); ++f) {
      if (alive_[f]) kept.push_back(facets_[f]);
    }
    facets_ = std::move(kept);
  }

  std::vector<Triangle>& facets_;
  const std::vector<GridPoint>& vertices_;
  const std::string& name_;
  std::vector<Triangle>& lost_;

  std::multimap<EdgeEnds, int> owner_;  // directed edge → facet
  std::vector<char> alive_;             // per facet
  std::vector<int> queue_;              // flat facets, the last is next
};

struct Half {
  int a, b, apex, facet;
};

// Of half-edges back along the edge of `f` (from `begin` to `end`), that whose
// facet the facet of `f` meets first when it is turned about the edge into the
// solid: between the two the solid is.
std::size_t FirstBehind(const GridSolid& solid, const Half& f,
                        const std::vector<Half>& halves, std::size_t begin,
                        std::size_t end) {
  const GridPoint& a = solid.vertices[f.a];
  const GridPoint along = solid.vertices[f.b] - a;
  const GridNormal& n = solid.normals[f.facet];
  const auto apex = [&](std::size_t i) {
    return solid.vertices[halves[i].apex] - a;
  };
  // 0 below the facet's plane, 1 beyond the edge in it, 2 above, 3 back on f.
  const auto part = [&](const GridPoint& u) {
    const int side = Sign(Dot(n, u));
    if (side != 0) return side < 0 ? 0 : 2;
    const GridNormal m = Cross(along, u);  // parallel to n
    const int k = LargestAxis(n);
    return Sign(m[k]) == Sign(n[k]) ? 3 : 1;
  };
  std::size_t first = begin;
  for (std::size_t i = begin + 1; i < end; ++i) {
    const GridPoint u = apex(i), v = apex(first);
    const int pu = part(u), pv = part(v);
    if (pu < pv || (pu == pv && Sign(Dot(Cross(along, u), v)) < 0)) first = i;
  }
  return first;
}

// Pairs half-edges a→b with b→a.  After joining coincident ends a pair of
// vertices may carry several: they are paired through the solid, as only then
// an edge is convex where the solid is.
void BuildEdges(GridSolid* solid, const std::string& name) {
  const std::vector<EdgeSide> sides =
      SortedEdgeSides(solid->facets, FoldedTriangles::kKept);
  solid->neighbors.assign(solid->vertices.size(), {});
  std::vector<Half> halves;  // of one edge, those low→high first
  ForEachEdge(sides, [&](std::size_t begin, std::size_t end) {
    halves.clear();
    std::size_t turn = 0;  // the first one back
    for (const bool is_forward : {true, false}) {
      turn = halves.size();
      for (std::size_t i = begin; i < end; ++i) {
        if (sides[i].is_forward != is_forward) continue;
        const Triangle& t = solid->facets[sides[i].triangle];
        const int k = sides[i].corner;
        halves.push_back(
            {t[k], t[(k + 1) % 3], t[(k + 2) % 3], sides[i].triangle});
      }
    }
    if (2 * turn != halves.size()) {
      throw InputError(name + ": expected a closed mesh, found an edge with " +
                       std::to_string(halves.size()) + " triangles");
    }
    const int low = sides[begin].low, high = sides[begin].high;
    for (std::size_t k = 0; k < turn; ++k) {
      const Half& forward = halves[k];
      // Those before are taken.
      std::swap(halves[turn + k], halves[FirstBehind(*solid, forward, halves,
                                                     turn + k, halves.size())]);
      const Half& backward = halves[turn + k];
      solid->edges.push_back({low, high, forward.apex, backward.apex,
                              forward.facet, backward.facet});
    }
    solid->neighbors[low].push_back(high);
    solid->neighbors[high].push_back(low);
  });
}

// What every predicate of the engine relies on: coordinates of kGridBits,
// facets with area, and edges whose facets run along them one each way.
[[maybe_unused]] bool IsSound(const GridSolid& solid) {
  for (const GridPoint& p : solid.vertices) {
    for (const std::int64_t x : p) {
      if (std::abs(x) > std::int64_t{1} << kGridBits) return false;
    }
  }
  for (const GridNormal& n : solid.normals) {
    if (IsZero(n)) return false;
  }
  const auto runs = [&](int facet, int a, int b, int apex) {
    const Triangle& t = solid.facets[facet];
    for (int k = 0; k < 3; ++k) {
      if (t[k] == a) return t[(k + 1) % 3] == b && t[(k + 2) % 3] == apex;
    }
    return false;
  };
  for (const GridEdge& e : solid.edges) {
    if (!runs(e.left, e.a, e.b, e.left_apex) ||
        !runs(e.right, e.b, e.a, e.right_apex)) {
      return false;
    }
  }
  return 2 * solid.edges.size() == 3 * solid.facets.size();
}

}  // namespace

GridSolid MakeGridSolid(const std::vector<GridPoint>& vertices,
                        const std::vector<Triangle>& triangles, bool reflect,
                        const std::string& name, const RoundedFrom* rounded) {
  GridSolid solid;
  solid.vertices = vertices;
  solid.facets = triangles;
  if (reflect) {
    for (GridPoint& p : solid.vertices) p = GridPoint{0, 0, 0} - p;
    for (Triangle& t : solid.facets) std::swap(t[1], t[2]);
  }
  std::vector<Triangle> lost;
  JoinCoincidentEnds(&solid.facets, solid.vertices, &lost);
  CollinearDissolver(&solid.facets, solid.vertices, name, &lost)
      .DissolveFacets();
  // A solid that rounding did not touch is one still.
  if (!solid.facets.empty() && rounded != nullptr) {
    MendRounding({*rounded, reflect, name}, std::move(lost), &solid);
  }
  if (solid.facets.empty()) {
    throw InputError(name +
                     ": expected a solid, found nothing thicker than "
                     "the grid step (2^-38 of the larger operand)");
  }
  solid.normals.reserve(solid.facets.size());
  for (const Triangle& t : solid.facets) {
    solid.normals.push_back(FacetNormal(solid.vertices, t));
  }
  BuildEdges(&solid, name);
  assert(IsSound(solid));
  return solid;
}

TriangleMesh ToMesh(const GridSolid& solid) {
  TriangleMesh mesh;
  mesh.vertices.reserve(solid.vertices.size());
  for (const GridPoint& p : solid.vertices) {
    mesh.vertices.push_back(ToDouble(p));
  }
  mesh.triangles = solid.facets;
  return mesh;
}

std::vector<BoundingBox> FacetBoxes(const GridSolid& solid) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(solid.facets.size());
  for (const Triangle& t : solid.facets) {
    const Eigen::Vector3d a = ToDouble(solid.vertices[t[0]]);
    const Eigen::Vector3d b = ToDouble(solid.vertices[t[1]]);
    const Eigen::Vector3d c = ToDouble(solid.vertices[t[2]]);
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  return boxes;
}

}  // namespace phongpd::internal
