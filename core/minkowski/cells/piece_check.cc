// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/piece_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>
#include <utility>

#include "core/minkowski/arrangement/plane_groups.h"

namespace phongpd::internal {
namespace {

// Half steps: sums of grid points, and what is defined by them (exact_grid.h).
constexpr std::int64_t kMostCoordinate = std::int64_t{1} << (kGridBits + 2);
constexpr Int128 kMostNormal = Int128(1) << 80;
constexpr Int128 kMostOffset = Int128(1) << 124;

bool IsIndex(int i, std::size_t size) {
  return i >= 0 && static_cast<std::size_t>(i) < size;
}
bool IsWithin(Int128 value, Int128 most) {
  return -most <= value && value <= most;
}
template <typename Vector, typename Most>
bool AreWithin(const Vector& values, Most most) {
  return std::all_of(values.begin(), values.end(),
                     [most](const auto& x) { return IsWithin(x, most); });
}

class PieceChecker {
 public:
  explicit PieceChecker(const SurfacePiece& piece) : piece_(piece) {}

  std::string Run() {
    static_cast<void>(ArePlanes() && AreSides() && ArePoints() && AreFaces() &&
                      AreEdgesPaired() && AreCounts());
    return defect_;
  }

 private:
  bool Refuse(const std::string& expected, const std::string& what,
              std::size_t number) {
    defect_ = "expected " + expected + ", found otherwise at " + what + " " +
              std::to_string(number);
    return false;
  }

  bool ArePlanes() {
    std::unordered_set<GridPlane, GridPlaneHash> known;
    for (std::size_t i = 0; i < piece_.planes.size(); ++i) {
      const GridPlane& plane = piece_.planes[i];
      if (!AreWithin(plane.normal, kMostNormal) ||
          !IsWithin(plane.offset, kMostOffset) || IsZero(plane.normal)) {
        return Refuse("normals that are not zero and in range", "plane", i);
      }
      if (!known.insert(plane).second) {
        return Refuse("every plane once", "plane", i);
      }
    }
    return true;
  }

  bool AreSides() {
    std::vector<char> known(2 * piece_.planes.size(), 0);
    for (std::size_t i = 0; i < piece_.sides.size(); ++i) {
      const SurfacePiece::Side& side = piece_.sides[i];
      if (!IsIndex(side.plane, piece_.planes.size()) ||
          side.kind < ContactKind::kObstacleFacet ||
          side.kind > ContactKind::kEdges) {
        return Refuse("a plane and a kind of each side", "side", i);
      }
      // As faces are joined by; planes that define points are any.
      GridPlane reduced = piece_.planes[side.plane];
      reduced.offset = 0;
      if (!(Coprime(reduced).normal == piece_.planes[side.plane].normal)) {
        return Refuse("coprime normals of one sign", "side", i);
      }
      char& is_known = known[2 * side.plane + (side.is_reversed ? 1 : 0)];
      if (is_known) return Refuse("every side once", "side", i);
      is_known = 1;
    }
    return true;
  }

  // Is it one point, in range?
  bool IsDefined(const SurfacePiece::Point& point) const {
    switch (point.kind) {
      case PointDefinition::kVertex:
        return AreWithin(point.a, kMostCoordinate);
      case PointDefinition::kEdge:
        return AreWithin(point.a, kMostCoordinate) &&
               AreWithin(point.b, kMostCoordinate) &&
               IsWithin(point.side_a, kMostOffset) &&
               IsWithin(point.side_b, kMostOffset) &&
               Sign(point.side_a) * Sign(point.side_b) < 0;
      case PointDefinition::kPlanes: {
        for (const int plane : point.planes) {
          if (!IsIndex(plane, piece_.planes.size())) return false;
        }
        const auto normal = [&](int k) -> const GridNormal& {
          return piece_.planes[point.planes[k]].normal;
        };
        const std::array<Wide, 3> cross = WideCross(normal(1), normal(2));
        Wide volume = 0;
        for (int k = 0; k < 3; ++k) volume += Wide(normal(0)[k]) * cross[k];
        return !volume.is_zero();
      }
    }
    return false;
  }

  bool ArePoints() {
    ExactPoints known;
    for (std::size_t i = 0; i < piece_.points.size(); ++i) {
      if (!IsDefined(piece_.points[i])) {
        return Refuse(
            "points defined by grid points in range, or planes that "
            "meet in one",
            "point", i);
      }
      const LocatedPoint point = Locate(DefinitionOf(piece_, piece_.points[i]));
      // Before it is put into a cell of the grid.
      if (!(point.approximate.lpNorm<Eigen::Infinity>() <=
            static_cast<double>(kMostCoordinate))) {
        return Refuse("points in range", "point", i);
      }
      if (known.Add(point) != static_cast<int>(i)) {
        return Refuse("every point once", "point", i);
      }
      points_.push_back(point);
    }
    return true;
  }

  bool IsOn(int plane, int point) const {
    const SurfacePiece::Point& p = piece_.points[point];
    return (p.kind == PointDefinition::kPlanes &&
            std::find(p.planes.begin(), p.planes.end(), plane) !=
                p.planes.end()) ||
           SideOf(piece_.planes[plane], points_[point]) == 0;
  }

  // Is the edge in a wall wherever it says so?
  bool IsInWalls(const SurfacePiece::Edge& e) const {
    if (e.walls < 0 || e.walls >= 8) return false;
    for (int axis = 0; axis < 3; ++axis) {
      if ((e.walls >> axis & 1) == 0) continue;
      GridPlane wall;
      wall.normal[axis] = 1;
      wall.offset = std::llround(points_[e.from].approximate[axis]);
      if (wall.offset % 2 == 0 || SideOf(wall, points_[e.from]) != 0 ||
          SideOf(wall, points_[e.to]) != 0) {
        return false;
      }
    }
    return true;
  }

  // Are the border's edges a turn around the face's left, up to rounding?
  bool HasArea(const SurfacePiece::Face& f, const SurfacePiece::Side& side) {
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    double rounding = 0.0;
    const Eigen::Vector3d& origin =
        points_[piece_.edges[f.begin].from].approximate;
    for (int h = f.begin; h < f.end; ++h) {
      const SurfacePiece::Edge& e = piece_.edges[h];
      const Eigen::Vector3d a = points_[e.from].approximate - origin;
      const Eigen::Vector3d b = points_[e.to].approximate - origin;
      twice += a.cross(b);
      rounding += 8 * kPointError * (a.lpNorm<1>() + b.lpNorm<1>() + 1.0);
    }
    const Eigen::Vector3d normal =
        ToDouble(piece_.planes[side.plane].normal).normalized();
    return twice.dot(normal) * (side.is_reversed ? -1.0 : 1.0) > -rounding;
  }

  bool AreFaces() {
    const std::size_t edges = piece_.edges.size();
    std::vector<bool> follows(edges, false);
    std::size_t at = 0;  // faces follow each other
    for (std::size_t i = 0; i < piece_.faces.size(); ++i) {
      const SurfacePiece::Face& f = piece_.faces[i];
      if (!IsIndex(f.side, piece_.sides.size()) ||
          f.begin != static_cast<int>(at) || f.end <= f.begin ||
          static_cast<std::size_t>(f.end) > edges) {
        return Refuse("a side and edges of each face", "face", i);
      }
      if (f.cell < -1 ||
          (f.cell >= 0 && static_cast<std::size_t>(f.cell) >= piece_.cells)) {
        return Refuse("a cell of the box of each face", "face", i);
      }
      const SurfacePiece::Side& side = piece_.sides[f.side];
      for (int h = f.begin; h < f.end; ++h) {
        const SurfacePiece::Edge& e = piece_.edges[h];
        if (!IsIndex(e.from, points_.size()) ||
            !IsIndex(e.to, points_.size()) || e.from == e.to) {
          return Refuse("two points of each edge", "edge", h);
        }
        // And their borders close.
        if (e.next < f.begin || e.next >= f.end || follows[e.next] ||
            piece_.edges[e.next].from != e.to) {
          return Refuse("borders of faces that close", "edge", h);
        }
        follows[e.next] = true;
        if (!IsOn(side.plane, e.from)) {
          return Refuse("points in the planes of their faces", "edge", h);
        }
        if (!IsInWalls(e)) {
          return Refuse("edges in the walls that they name", "edge", h);
        }
      }
      if (!HasArea(f, side)) {
        return Refuse("faces on the left of their borders", "face", i);
      }
      at = static_cast<std::size_t>(f.end);
    }
    if (at != edges) return Refuse("edges of faces only", "edge", at);
    return true;
  }

  // Inside a box faces end at each other.
  bool AreEdgesPaired() {
    std::map<std::pair<int, int>, int> surplus;
    for (const SurfacePiece::Edge& e : piece_.edges) {
      if (e.walls == 0) {
        surplus[std::minmax(e.from, e.to)] += e.from < e.to ? 1 : -1;
      }
    }
    for (std::size_t h = 0; h < piece_.edges.size(); ++h) {
      const SurfacePiece::Edge& e = piece_.edges[h];
      if (e.walls == 0 && surplus[std::minmax(e.from, e.to)] != 0) {
        return Refuse("faces on both sides of each edge in no wall", "edge", h);
      }
    }
    return true;
  }

  bool AreCounts() {
    if (piece_.judged <= piece_.cells && piece_.arranged <= kMostCounted &&
        piece_.cells <= 2 * piece_.arranged &&
        piece_.faces.size() <= piece_.arranged) {
      return true;
    }
    defect_ = "expected faces and cells of one arrangement, found other counts";
    return false;
  }
  static constexpr std::size_t kMostCounted = std::size_t{1} << 40;

  const SurfacePiece& piece_;
  std::vector<LocatedPoint> points_;
  std::string defect_;
};

}  // namespace

std::string PieceDefect(const SurfacePiece& piece) {
  return PieceChecker(piece).Run();
}

}  // namespace phongpd::internal
