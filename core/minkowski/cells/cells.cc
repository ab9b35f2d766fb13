// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/mesh/union_find.h"
#include "core/minkowski/arrangement/face_geometry.h"
#include "core/minkowski/cells/cell_probe.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Grid steps: far above the rounding of a ray's hits.
constexpr double kClearGap = 16.0;
// Rays tried to find the outside.
constexpr std::size_t kOuterRays = 64;

// A side of the unbounded cell: what a ray from far away hits first.  Rays
// against the largest faces are tried until one tells its first two hits
// clearly apart; sheets closer than rounding look alike.
int OuterSide(const FaceGeometry& geometry, const std::vector<int>& largest,
              double reach) {
  double best = -1.0;
  int side = 0;
  for (const int target : largest) {
    const Vector3d n = geometry.Normal(target);
    const Vector3d start = geometry.InteriorPoint(target) + 4.0 * reach * n;
    const std::vector<FaceGeometry::Hit> hits = geometry.AllHits(start, -n, -1);
    if (hits.empty()) continue;
    const double gap =
        hits.size() > 1 ? hits[1].distance - hits[0].distance : reach;
    if (gap <= best) continue;
    best = gap;
    const int face = hits[0].face;
    side = geometry.Normal(face).dot(n) > 0 ? PlusSide(face) : MinusSide(face);
    if (best > kClearGap) break;
  }
  return side;
}

// Parts of the arrangement that share no edge, as the vertex-disjoint sums of
// an obstacle's components do, have an outside each.  Returns the side that
// `side` of a free cell sees across the gap to the next part, kUnbounded when
// there is nothing beyond, or -1 when its cell is bounded by its own part.
constexpr int kUnbounded = -2;
int SideAcrossGap(const FaceGeometry& geometry, UnionFind* sides,
                  UnionFind* parts, int side) {
  const int face = side / 2;  // candidate cells hold + sides only
  const Vector3d n = geometry.Normal(face);
  const auto looking_back = [&](int f) {
    return geometry.Normal(f).dot(n) > 0 ? MinusSide(f) : PlusSide(f);
  };
  const std::vector<FaceGeometry::Hit> hits =
      geometry.AllHits(geometry.InteriorPoint(face), n, face);
  int exit = side;  // the last side of this part, looking along n
  int across = hits.empty() ? kUnbounded : looking_back(hits[0].face);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const int f = hits[i].face;
    if (parts->Find(f) != parts->Find(face)) continue;
    exit = OppositeSide(looking_back(f));
    across = i + 1 < hits.size() ? looking_back(hits[i + 1].face) : kUnbounded;
  }
  return sides->Find(exit) == sides->Find(side) ? across : -1;
}

// collide(probe) → whether the operands overlap at probe(); from any thread.
template <typename Collide>
FreeCells FindCells(const Convolution& convolution,
                    const Arrangement& arrangement, const EdgeRings& rings,
                    const ExactPoints& points, const Collide& collide) {
  const std::vector<ArrangementFace>& faces = arrangement.faces;
  const int count = static_cast<int>(faces.size());
  UnionFind sides = JoinSides(rings, faces.size());
  UnionFind parts(faces.size());  // faces that share an edge
  for (const EdgeRing& ring : rings.rings) {
    for (int k = ring.begin + 1; k < ring.end; ++k) {
      parts.Join(rings.spokes[k - 1].face, rings.spokes[k].face);
    }
  }
  std::vector<char> occupied(2 * faces.size(), 0);
  for (int f = 0; f < count; ++f) {
    occupied[sides.Find(MinusSide(f))] = 1;
    if (faces[f].two_sided) occupied[sides.Find(PlusSide(f))] = 1;
  }

  FaceGeometry geometry(convolution, arrangement, points);
  std::vector<double> area(faces.size());
  for (int f = 0; f < count; ++f) area[f] = geometry.Area(f);
  double reach = 0.0;
  for (const GridPoint& p : convolution.points) {
    reach = std::max(reach, ToDouble(p).lpNorm<Eigen::Infinity>());
  }
  std::vector<int> largest(faces.size());
  std::iota(largest.begin(), largest.end(), 0);
  const std::size_t rays = std::min(kOuterRays, largest.size());
  std::partial_sort(largest.begin(), largest.begin() + rays, largest.end(),
                    [&area](int a, int b) {
                      return area[a] != area[b] ? area[a] > area[b] : a < b;
                    });
  largest.resize(rays);
  const int outer = sides.Find(OuterSide(geometry, largest, reach));
  if (occupied[outer]) {
    throw LeakError(
        "contact space leaks: the unbounded cell touches the inside of a "
        "facet; an operand is not a closed solid without self-intersections");
  }

  std::map<int, std::vector<int>> candidates;  // cell → its + sides
  FreeCells out;
  for (int s = 0; s < 2 * count; ++s) {
    const int cell = sides.Find(s);
    if (cell == s) ++out.cells;
    if (!occupied[cell]) candidates[cell].push_back(s);
  }
  if (candidates.size() > 4) geometry.BuildTree();
  std::vector<char> is_free(2 * faces.size(), 0);
  is_free[outer] = 1;
  std::vector<std::vector<int>*> judged;
  for (auto& [cell, members] : candidates) {
    if (cell != outer) judged.push_back(&members);
  }
  out.judged = static_cast<int>(judged.size());
  std::vector<char> collides(judged.size());
  tbb::parallel_for(std::size_t{0}, judged.size(), [&](std::size_t i) {
    collides[i] =
        collide([&] { return ProbePoint(geometry, area, judged[i], reach); });
  });
  std::vector<int> free_sides;  // one of each free cell but the unbounded
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const int side = judged[i]->front();
    if (collides[i]) continue;
    is_free[sides.Find(side)] = 1;
    free_sides.push_back(side);
  }
  // Only now that all are judged, so that a ray can cause no leak.
  std::vector<std::pair<int, int>> gaps;
  for (const int side : free_sides) {
    const int across = SideAcrossGap(geometry, &sides, &parts, side);
    const int other = across == kUnbounded ? outer : across;
    if (other >= 0 && is_free[sides.Find(other)]) gaps.push_back({side, other});
  }
  free_sides.push_back(outer);
  for (const auto& [side, other] : gaps) {
    out.cells -= sides.Find(side) != sides.Find(other);
    sides.Join(side, other);
  }
  std::set<int> free_cells;
  for (const int side : free_sides) free_cells.insert(sides.Find(side));
  for (const int cell : free_cells) is_free[cell] = 1;
  out.cavities = static_cast<int>(free_cells.size()) - 1;
  out.side_is_free.resize(2 * faces.size());
  out.side_is_outer.resize(2 * faces.size());
  for (int s = 0; s < 2 * count; ++s) {
    const int cell = sides.Find(s);
    out.side_is_free[s] = is_free[cell];
    out.side_is_outer[s] = cell == sides.Find(outer);
  }
  return out;
}

}  // namespace

FreeCells FindFreeCells(const Convolution& convolution,
                        const Arrangement& arrangement, const EdgeRings& rings,
                        const ExactPoints& points, const SolidCollision& judge,
                        const BuildLimits& limits) {
  return FindCells(convolution, arrangement, rings, points,
                   [&](const auto& probe) {
                     limits.Check("cells");
                     return judge.Collide(probe());
                   });
}

FreeCells FindCellsOfSurface(const Convolution& convolution,
                             const Arrangement& arrangement,
                             const EdgeRings& rings,
                             const ExactPoints& points) {
  return FindCells(convolution, arrangement, rings, points,
                   [](const auto&) { return false; });
}

}  // namespace phongpd::internal
