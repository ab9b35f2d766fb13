// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "core/contact_space/union_find.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Facets of a cell from which a judging point is tried: the largest are the
// best, and the point farthest from any other facet wins.
constexpr std::size_t kProbes = 4;

struct RayHit {
  double distance = std::numeric_limits<double>::infinity();
  int facet = -1;
};

// The arrangement in double, for rays that only choose a good judging point.
class RoundedFacets {
 public:
  RoundedFacets(const std::vector<ArrangementFacet>& facets,
                const ExactPoints& points)
      : facets_(facets), points_(points) {}

  const Vector3d& Corner(int facet, int k) const {
    return points_.Approximate(facets_[facet].corners[k]);
  }
  Vector3d Centroid(int facet) const {
    return (Corner(facet, 0) + Corner(facet, 1) + Corner(facet, 2)) / 3.0;
  }
  // Twice the area as length.
  Vector3d AreaVector(int facet) const {
    return (Corner(facet, 1) - Corner(facet, 0))
        .cross(Corner(facet, 2) - Corner(facet, 0));
  }

  // First facet hit by from + t·direction, t > 0, other than `self`.
  RayHit FirstHit(const Vector3d& from, const Vector3d& direction,
                  int self) const {
    const tbb::blocked_range<int> all(0, static_cast<int>(facets_.size()),
                                      4096);
    return tbb::parallel_reduce(
        all, RayHit(),
        [&](const tbb::blocked_range<int>& range, RayHit best) {
          for (int f = range.begin(); f < range.end(); ++f) {
            if (f == self) continue;
            const double t = Intersect(f, from, direction);
            if (t < best.distance) best = {t, f};
          }
          return best;
        },
        [](const RayHit& a, const RayHit& b) {
          return a.distance < b.distance ||
                         (a.distance == b.distance && a.facet < b.facet)
                     ? a
                     : b;
        });
  }

 private:
  // Ray parameter of the hit, or infinity (Möller–Trumbore).
  double Intersect(int f, const Vector3d& from,
                   const Vector3d& direction) const {
    constexpr double kMiss = std::numeric_limits<double>::infinity();
    const Vector3d e1 = Corner(f, 1) - Corner(f, 0);
    const Vector3d e2 = Corner(f, 2) - Corner(f, 0);
    const Vector3d p = direction.cross(e2);
    const double det = e1.dot(p);
    if (det == 0.0) return kMiss;
    const Vector3d o = from - Corner(f, 0);
    const double u = o.dot(p) / det;
    if (u < 0 || u > 1) return kMiss;
    const Vector3d q = o.cross(e1);
    const double v = direction.dot(q) / det;
    if (v < 0 || u + v > 1) return kMiss;
    const double t = e2.dot(q) / det;
    return t > 0 ? t : kMiss;
  }

  const std::vector<ArrangementFacet>& facets_;
  const ExactPoints& points_;
};

// A side of the unbounded cell: what a ray from far away hits first.
int OuterSide(const RoundedFacets& rounded, int largest, double reach) {
  const Vector3d n = rounded.AreaVector(largest).normalized();
  const Vector3d start = rounded.Centroid(largest) + 4.0 * reach * n;
  const RayHit hit = rounded.FirstHit(start, -n, -1);
  const int facet = hit.facet >= 0 ? hit.facet : largest;
  return rounded.AreaVector(facet).dot(n) > 0 ? PlusSide(facet)
                                              : MinusSide(facet);
}

// A point well inside the cell that `sides` (the largest first) look into.
Vector3d ProbePoint(const RoundedFacets& rounded, const std::vector<int>& sides,
                    double reach) {
  double best = -1.0;
  Vector3d point = Vector3d::Zero();
  for (std::size_t k = 0; k < std::min(kProbes, sides.size()); ++k) {
    const int facet = sides[k] / 2;  // candidate cells hold + sides only
    const Vector3d from = rounded.Centroid(facet);
    const Vector3d n = rounded.AreaVector(facet).normalized();
    if (!n.allFinite()) continue;
    const double gap =
        std::min(rounded.FirstHit(from, n, facet).distance, 0.02 * reach);
    if (gap > best) {
      best = gap;
      point = from + 0.5 * gap * n;
    }
  }
  return point;
}

}  // namespace

FreeCells FindFreeCells(const Convolution& convolution,
                        const std::vector<ArrangementFacet>& facets,
                        const EdgeRings& rings, const ExactPoints& points,
                        const SolidCollision& judge) {
  const int count = static_cast<int>(facets.size());
  UnionFind sides(2 * facets.size());
  for (const EdgeRing& ring : rings.rings) {
    for (int k = ring.begin; k < ring.end; ++k) {
      const int next = k + 1 < ring.end ? k + 1 : ring.begin;
      sides.Join(rings.facets[k].SideToNext(),
                 rings.facets[next].SideToPrevious());
    }
  }
  std::vector<char> occupied(2 * facets.size(), 0);
  for (int f = 0; f < count; ++f) {
    occupied[sides.Find(MinusSide(f))] = 1;
    if (facets[f].two_sided) occupied[sides.Find(PlusSide(f))] = 1;
  }

  const RoundedFacets rounded(facets, points);
  std::vector<double> area(facets.size());
  for (int f = 0; f < count; ++f) area[f] = rounded.AreaVector(f).norm();
  const int largest = static_cast<int>(
      std::max_element(area.begin(), area.end()) - area.begin());
  double reach = 0.0;
  for (const GridPoint& p : convolution.points) {
    reach = std::max(reach, ToDouble(p).lpNorm<Eigen::Infinity>());
  }
  const int outer = sides.Find(OuterSide(rounded, largest, reach));
  if (occupied[outer]) {
    throw std::logic_error(
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
  std::vector<char> is_free(2 * facets.size(), 0);
  is_free[outer] = 1;
  for (auto& [cell, members] : candidates) {
    if (cell == outer) continue;
    const std::size_t probes = std::min(kProbes, members.size());
    std::partial_sort(
        members.begin(), members.begin() + probes, members.end(),
        [&area](int a, int b) {
          return area[a / 2] != area[b / 2] ? area[a / 2] > area[b / 2] : a < b;
        });
    ++out.judged;
    if (judge.Collide(ProbePoint(rounded, members, reach))) continue;
    is_free[cell] = 1;
    ++out.cavities;
  }
  out.side_is_free.resize(2 * facets.size());
  out.side_is_outer.resize(2 * facets.size());
  for (int s = 0; s < 2 * count; ++s) {
    const int cell = sides.Find(s);
    out.side_is_free[s] = is_free[cell];
    out.side_is_outer[s] = cell == outer;
  }
  return out;
}

}  // namespace phongpd::internal
