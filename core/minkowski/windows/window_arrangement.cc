// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/windows/window_arrangement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/mesh/union_find.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kWholeWalls = 6;

double SquaredDistanceToEdge(const Vector3d& a, const Vector3d& b,
                             Vector3d* nearest) {
  const Vector3d along = b - a;
  const double length = along.squaredNorm();
  const double t =
      length > 0.0 ? std::clamp(-a.dot(along) / length, 0.0, 1.0) : 0.0;
  *nearest = a + t * along;
  return nearest->squaredNorm();
}

}  // namespace

WindowArrangement::WindowArrangement(const WindowConvolution& sums,
                                     const GridWindow& window,
                                     std::vector<WallPatch> the_patches,
                                     const BuildLimits& limits)
    : first_wall(static_cast<int>(sums.convolution.facets.size())),
      box{ToDouble(window.min), ToDouble(window.max)},
      patches(std::move(the_patches)),
      convolution(WithWalls(sums.convolution, patches)),
      groups(GroupByPlane(convolution)) {
  const FacetIndex index(convolution, box);
  FacetIntersections intersections =
      IntersectFacets(convolution, groups, index, limits, &points);
  if (patches.size() > kWholeWalls) CutAlongPatches(&intersections);
  arrangement =
      ArrangePlanes(convolution, groups, intersections, limits, &points);
  radial = SortAroundEdges(convolution, arrangement, points);
}

// Patches of one wall lie in one plane, in which the borders between them
// would be lost.
void WindowArrangement::CutAlongPatches(FacetIntersections* intersections) {
  std::map<std::pair<int, std::int64_t>, int> cutters;  // planes by number
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const int facet = first_wall + 2 * static_cast<int>(k);
    std::vector<PlaneSegment>& segments =
        intersections->segments[groups.of_facet[facet]];
    for (const int half : {facet, facet + 1}) {
      const Triangle& t = convolution.facets[half].corners;
      // Corners 0, 1, 2 and 0, 2, 3: all sides but the diagonal 0–2.
      for (const int side : {half == facet ? 0 : 1, half == facet ? 1 : 2}) {
        const int a = t[side], b = t[(side + 1) % 3];
        const GridPoint& p = convolution.points[a];
        const GridPoint along = convolution.points[b] - p;
        const int across = 3 - patches[k].axis - LargestAxis(along);
        const auto [it, is_new] =
            cutters.emplace(std::pair(across, p[across]),
                            static_cast<int>(groups.planes.size()));
        if (is_new) {
          GridPlane plane;
          plane.normal[across] = 1;
          plane.offset = p[across];
          groups.planes.push_back(plane);
        }
        const auto [from, to] = std::minmax(
            {intersections->point_ids[a], intersections->point_ids[b]});
        segments.push_back({from, to, it->second});
      }
    }
  }
  for (std::vector<PlaneSegment>& s : intersections->segments) {
    std::sort(s.begin(), s.end());
    s.erase(std::unique(s.begin(), s.end(),
                        [](const PlaneSegment& a, const PlaneSegment& b) {
                          return a.from == b.from && a.to == b.to;
                        }),
            s.end());
  }
}

// Faces are joined where they share an edge that is in no wall: each such
// part is in the window or outside.  One that has an edge in a wall shows
// which by the side of the wall it lies on.
std::vector<char> WindowArrangement::FindInside() const {
  const std::size_t count = arrangement.faces.size();
  UnionFind parts(count);
  std::vector<char> inside(count, 0), known(count, 0);
  std::vector<std::pair<int, char>> told;
  for (const RadialEdge& edge : radial.edges) {
    const int size = edge.end - edge.begin;
    const auto spoke = [&](int k) -> const Spoke& {
      return radial.spokes[edge.begin + k % size];
    };
    int wall = 0;
    while (wall < size && !IsWall(spoke(wall).face)) ++wall;
    if (wall == size) {
      for (int k = 0; k + 1 < size; ++k) {
        parts.Join(spoke(k).face, spoke(k + 1).face);
      }
      continue;
    }
    // What follows a wall up to the next one lies on the side that the wall
    // has there.
    char is_inside = 0;
    for (int k = wall; k < wall + size; ++k) {
      const Spoke& s = spoke(k);
      if (IsWall(s.face)) {
        is_inside = s.SideToNext() == PlusSide(s.face);
      } else {
        told.emplace_back(s.face, is_inside);
      }
    }
  }
  for (const auto& [face, is_inside] : told) {
    inside[parts.Find(face)] = is_inside;
    known[parts.Find(face)] = 1;
  }
  std::vector<char> result(count, 0);
  for (std::size_t f = 0; f < count; ++f) {
    const int face = static_cast<int>(f), part = parts.Find(face);
    if (!known[part]) {  // it touches no wall
      const Vector3d& p = points.Approximate(
          arrangement.half_edges[arrangement.faces[f].begin].from);
      inside[part] = (p.array() > box.min.array()).all() &&
                     (p.array() < box.max.array()).all();
      known[part] = 1;
    }
    result[f] = IsWall(face) || inside[part];
  }
  return result;
}

WindowArrangement::FacePoint WindowArrangement::NearestOn(int face,
                                                          const Vector3d& q,
                                                          double limit) const {
  const ArrangementFace& f = arrangement.faces[face];
  const ConvolutionFacet& facet = convolution.facets[f.facet];
  const Vector3d n = ToDouble(facet.normal).normalized();
  const double height =
      n.dot(ToDouble(convolution.points[facet.corners[0]]) - q);
  FacePoint best;
  if (height * height >= limit) return best;
  const Vector3d foot = height * n;
  const int axis = LargestAxis(n), u = (axis + 1) % 3, v = (axis + 2) % 3;
  bool holds_foot = false;
  for (int h = f.begin; h < f.end; ++h) {
    const HalfEdge& e = arrangement.half_edges[h];
    const Vector3d a = points.Approximate(e.from) - q;
    const Vector3d b = points.Approximate(e.to) - q;
    Vector3d nearest;
    const double squared = SquaredDistanceToEdge(a, b, &nearest);
    if (squared < best.squared_distance) best = {squared, nearest};
    if ((a[v] > foot[v]) == (b[v] > foot[v])) continue;
    const double at = a[u] + (foot[v] - a[v]) * ((b[u] - a[u]) / (b[v] - a[v]));
    if (at > foot[u]) holds_foot = !holds_foot;
  }
  if (holds_foot && height * height < best.squared_distance) {
    best = {height * height, foot};
  }
  return best;
}

int WindowArrangement::FacetAt(int face, const Vector3d& point) const {
  const int representative = arrangement.faces[face].facet;
  const int group = groups.of_facet[representative];
  int best = representative;
  double least = kInfinity;
  for (const int f : groups.members[group]) {
    if (groups.reversed[f] != groups.reversed[representative]) continue;
    const double squared = SquaredDistanceInPlane(f, point);
    if (squared < least) {
      least = squared;
      best = f;
    }
  }
  return best;
}

double WindowArrangement::SquaredDistanceInPlane(int f,
                                                 const Vector3d& point) const {
  const ConvolutionFacet& facet = convolution.facets[f];
  const Vector3d n = ToDouble(facet.normal);
  bool inside = true;
  double least = kInfinity;
  for (int k = 0; k < 3; ++k) {
    const Vector3d a = ToDouble(convolution.points[facet.corners[k]]) - point;
    const Vector3d b =
        ToDouble(convolution.points[facet.corners[(k + 1) % 3]]) - point;
    Vector3d nearest;
    least = std::min(least, SquaredDistanceToEdge(a, b, &nearest));
    if (n.dot((b - a).cross(-a)) < 0.0) inside = false;
  }
  return inside ? 0.0 : least;
}

bool WindowArrangement::LiesInPlane(int face, const Vector3d& q) const {
  const ConvolutionFacet& facet =
      convolution.facets[arrangement.faces[face].facet];
  const GridPoint& origin = convolution.points[facet.corners[0]];
  Wide side = 0;
  for (int k = 0; k < 3; ++k) {
    const Wide x = std::llround(std::ldexp(q[k], 11));
    side += Wide(facet.normal[k]) * (x - (Wide(origin[k]) << 11));
  }
  return side.is_zero();
}

std::vector<int> WindowArrangement::WallsOfEdges() const {
  std::vector<int> walls(arrangement.half_edges.size(), 0);
  for (const RadialEdge& edge : radial.edges) {
    int bits = 0;
    for (int k = edge.begin; k < edge.end; ++k) {
      const int face = radial.spokes[k].face;
      if (!IsWall(face)) continue;
      bits |= 1 << LargestAxis(
                  convolution.facets[arrangement.faces[face].facet].normal);
    }
    for (int k = edge.begin; bits != 0 && k < edge.end; ++k) {
      walls[radial.spokes[k].half_edge] = bits;
    }
  }
  return walls;
}

BoundingBox WindowArrangement::BoxOf(int face) const {
  const ArrangementFace& f = arrangement.faces[face];
  BoundingBox out;
  for (int h = f.begin; h < f.end; ++h) {
    const Vector3d& p = points.Approximate(arrangement.half_edges[h].from);
    out.min = h == f.begin ? p : out.min.cwiseMin(p);
    out.max = h == f.begin ? p : out.max.cwiseMax(p);
  }
  return out;
}

int WindowArrangement::PatchOf(int face, const BoundingBox& around) const {
  const WallPatch& wall = patches[static_cast<std::size_t>(
      (arrangement.faces[face].facet - first_wall) / 2)];
  const Vector3d middle = around.Center();
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const WallPatch& p = patches[k];
    if (p.axis != wall.axis || p.is_high != wall.is_high) continue;
    const Vector3d low = ToDouble(p.min), high = ToDouble(p.max);
    bool is_within = true;
    for (int i = 0; i < 3; ++i) {
      is_within = is_within && (i == p.axis ||
                                (low[i] <= middle[i] && middle[i] <= high[i]));
    }
    if (is_within) return static_cast<int>(k);
  }
  return -1;  // not reached: the patches make up the wall
}

}  // namespace phongpd::internal
