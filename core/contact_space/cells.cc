// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/cells.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "core/contact_space/face_geometry.h"
#include "core/contact_space/union_find.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Faces of a cell from which a judging point is tried: the largest are the
// best, and the point farthest from any other face wins.
constexpr std::size_t kProbes = 4;

// A side of the unbounded cell: what a ray from far away hits first.
int OuterSide(const FaceGeometry& geometry, int largest, double reach) {
  const Vector3d n = geometry.Normal(largest);
  const Vector3d start = geometry.InteriorPoint(largest) + 4.0 * reach * n;
  const FaceGeometry::Hit hit = geometry.FirstHit(start, -n, 16.0 * reach, -1);
  const int face = hit.face >= 0 ? hit.face : largest;
  return geometry.Normal(face).dot(n) > 0 ? PlusSide(face) : MinusSide(face);
}

// A point well inside the cell that `sides` (the largest first) look into.
Vector3d ProbePoint(const FaceGeometry& geometry, const std::vector<int>& sides,
                    double reach) {
  double best = -1.0;
  Vector3d point = Vector3d::Zero();
  for (std::size_t k = 0; k < std::min(kProbes, sides.size()); ++k) {
    const int face = sides[k] / 2;  // candidate cells hold + sides only
    const Vector3d from = geometry.InteriorPoint(face);
    const Vector3d n = geometry.Normal(face);
    const double gap = geometry.FirstHit(from, n, 0.02 * reach, face).distance;
    if (gap > best) {
      best = gap;
      point = from + 0.5 * gap * n;
    }
  }
  return point;
}

}  // namespace

FreeCells FindFreeCells(const Convolution& convolution,
                        const Arrangement& arrangement, const EdgeRings& rings,
                        const ExactPoints& points,
                        const SolidCollision& judge) {
  const std::vector<ArrangementFace>& faces = arrangement.faces;
  const int count = static_cast<int>(faces.size());
  UnionFind sides(2 * faces.size());
  for (const EdgeRing& ring : rings.rings) {
    for (int k = ring.begin; k < ring.end; ++k) {
      const int next = k + 1 < ring.end ? k + 1 : ring.begin;
      sides.Join(rings.spokes[k].SideToNext(),
                 rings.spokes[next].SideToPrevious());
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
  const int largest = static_cast<int>(
      std::max_element(area.begin(), area.end()) - area.begin());
  double reach = 0.0;
  for (const GridPoint& p : convolution.points) {
    reach = std::max(reach, ToDouble(p).lpNorm<Eigen::Infinity>());
  }
  const int outer = sides.Find(OuterSide(geometry, largest, reach));
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
  if (candidates.size() > 4) geometry.BuildTree();
  std::vector<char> is_free(2 * faces.size(), 0);
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
    if (judge.Collide(ProbePoint(geometry, members, reach))) continue;
    is_free[cell] = 1;
    ++out.cavities;
  }
  out.side_is_free.resize(2 * faces.size());
  out.side_is_outer.resize(2 * faces.size());
  for (int s = 0; s < 2 * count; ++s) {
    const int cell = sides.Find(s);
    out.side_is_free[s] = is_free[cell];
    out.side_is_outer[s] = cell == outer;
  }
  return out;
}

}  // namespace phongpd::internal
