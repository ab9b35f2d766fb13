// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/surface_join.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "core/minkowski/cells/cells.h"
#include "core/minkowski/cells/radial_edges.h"

namespace phongpd::internal {
namespace {

// A line in a wall across `axis` at `at`: coprime, without component there.
struct WallLine {
  int axis = 0;
  std::int64_t at = 0;
  GridPlane line;
  bool operator==(const WallLine& o) const {
    return axis == o.axis && at == o.at && line == o.line;
  }
};
struct WallLineHash {
  std::size_t operator()(const WallLine& l) const {
    return GridPlaneHash()(l.line) ^ GridPointHash()({l.axis, l.at, 0});
  }
};

// Half-edges that one of a piece is split into, on the average, at the most:
// on a line of n edges' ends, 2 n - 1 parts lie beside at most four faces in
// each of at most four windows.
constexpr std::size_t kMostSplits = 32;

// Walls of windows are the only planes across an axis with an odd offset.
bool IsWall(const GridPlane& plane) {
  const int axis = LargestAxis(plane.normal);
  return plane.normal[axis] == 1 && plane.normal[(axis + 1) % 3] == 0 &&
         plane.normal[(axis + 2) % 3] == 0 && plane.offset % 2 != 0;
}

GridPlane WallPlane(int axis, std::int64_t at) {
  GridPlane plane;
  plane.normal[axis] = 1;
  plane.offset = at;
  return plane;
}

class Joiner {
 public:
  explicit Joiner(JoinedSurface* out) : out_(out) {}

  void Add(const SurfacePiece& piece) {
    std::vector<int> sides, ids;
    for (const SurfacePiece::Side& side : piece.sides) {
      sides.push_back(SideOfPlane(piece.planes[side.plane], side));
    }
    for (const SurfacePiece::Point& point : piece.points) {
      ids.push_back(out_->points.Add(Locate(DefinitionOf(piece, point))));
    }
    const int first = static_cast<int>(edges_.size());
    int next_cell = cells_;
    for (const SurfacePiece::Edge& e : piece.edges) {
      edges_.push_back({ids[e.from], ids[e.to], first + e.next, e.walls});
    }
    for (const SurfacePiece::Face& f : piece.faces) {
      const int cell = f.cell < 0 ? -1 : cells_ + f.cell;
      next_cell = std::max(next_cell, cell + 1);
      faces_.push_back({sides[f.side], first + f.begin, first + f.end, cell});
      if (!IsWallSide(sides[f.side])) continue;
      for (int h = first + f.begin; h < first + f.end; ++h) {
        edges_[h].walls |= WallsThrough(edges_[h]);
      }
    }
    cells_ = next_cell;
  }

  // With edges in walls split where others end on their line, and without the
  // cells that turn out occupied.
  Arrangement Take() {
    const Arrangement split = Split();
    if (cells_ == 0) return split;
    const std::vector<char> is_free = FindFreeFaces(split);
    Arrangement out;
    for (std::size_t f = 0; f < split.faces.size(); ++f) {
      if (!is_free[f]) continue;
      ArrangementFace face = split.faces[f];
      const int shift = static_cast<int>(out.half_edges.size()) - face.begin;
      for (int h = face.begin; h < face.end; ++h) {
        HalfEdge e = split.half_edges[h];
        e.face = static_cast<int>(out.faces.size());
        e.next += shift;
        out.half_edges.push_back(e);
      }
      face.begin += shift;
      face.end += shift;
      out.faces.push_back(face);
    }
    return out;
  }

 private:
  Arrangement Split() {
    FindLines();
    Arrangement out;
    std::vector<int> first_of(edges_.size());
    for (const SurfacePiece::Face& f : faces_) {
      const int face = static_cast<int>(out.faces.size());
      const int begin = static_cast<int>(out.half_edges.size());
      for (int h = f.begin; h < f.end; ++h) {
        first_of[h] = static_cast<int>(out.half_edges.size());
        int from = edges_[h].from;
        for (const int point : InnerPoints(edges_[h], f.side)) {
          const int next = static_cast<int>(out.half_edges.size()) + 1;
          out.half_edges.push_back({from, point, face, next});
          in_wall_.push_back(1);
          from = point;
        }
        // In a line of two walls no more than a few faces lie side by side.
        if (out.half_edges.size() > kMostSplits * edges_.size()) {
          throw SurfaceError("contact space: pieces overlap in a wall");
        }
        out.half_edges.push_back({from, edges_[h].to, face, -1 - h});
        in_wall_.push_back(edges_[h].walls != 0 ? 1 : 0);
      }
      out.faces.push_back(
          {f.side, false, begin, static_cast<int>(out.half_edges.size())});
    }
    for (HalfEdge& e : out.half_edges) {
      if (e.next < 0) e.next = first_of[edges_[-1 - e.next].next];
    }
    return out;
  }

  // Thin cells are free where a free face goes on in them, beyond a wall.
  std::vector<char> FindFreeFaces(const Arrangement& split) const {
    std::unordered_map<GridPoint, int, GridPointHash> faces;  // side, ends
    std::vector<std::vector<int>> of_cell(static_cast<std::size_t>(cells_));
    std::vector<char> is_free(split.faces.size(), 0);
    std::vector<int> open;
    for (std::size_t f = 0; f < split.faces.size(); ++f) {
      const int face = static_cast<int>(f), cell = faces_[f].cell;
      if (cell < 0) {
        is_free[f] = 1;
        open.push_back(face);
      } else {
        of_cell[cell].push_back(face);
      }
      for (int h = split.faces[f].begin; h < split.faces[f].end; ++h) {
        const HalfEdge& e = split.half_edges[h];
        // A wall tells nothing of what goes on in it.
        if (in_wall_[h] && !IsWallSide(faces_[f].side)) {
          faces.emplace(GridPoint{faces_[f].side, e.from, e.to}, face);
        }
      }
    }
    while (!open.empty()) {
      const int face = open.back();
      open.pop_back();
      const ArrangementFace& f = split.faces[face];
      for (int h = f.begin; h < f.end; ++h) {
        if (!in_wall_[h]) continue;
        const HalfEdge& e = split.half_edges[h];
        const auto beyond =
            faces.find(GridPoint{faces_[face].side, e.to, e.from});
        if (beyond == faces.end() || is_free[beyond->second]) continue;
        for (const int g : of_cell[faces_[beyond->second].cell]) {
          is_free[g] = 1;
          open.push_back(g);
        }
      }
    }
    return is_free;
  }

  int SideOfPlane(const GridPlane& plane, const SurfacePiece::Side& side) {
    PlaneGroups& groups = out_->groups;
    const auto [it, is_new] =
        planes_.emplace(plane, static_cast<int>(groups.planes.size()));
    if (is_new) {
      groups.planes.push_back(plane);
      for (const bool reversed : {false, true}) {
        ConvolutionFacet facet;
        facet.corners = {0, 0, 0};
        facet.normal = reversed ? Negated(plane.normal) : plane.normal;
        out_->sides.facets.push_back(facet);
        groups.of_facet.push_back(it->second);
        groups.reversed.push_back(reversed ? 1 : 0);
      }
    }
    const int number = 2 * it->second + (side.is_reversed ? 1 : 0);
    out_->sides.facets[number].kind = side.kind;
    return number;
  }

  bool IsWallSide(int side) const {
    return IsWall(out_->groups.planes[side / 2]);
  }

  // Bit k where an edge of a wall lies in a plane across axis k in which there
  // are walls, too.
  int WallsThrough(const SurfacePiece::Edge& edge) const {
    int bits = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d& from = out_->points.Approximate(edge.from);
      const Eigen::Vector3d& to = out_->points.Approximate(edge.to);
      if (std::abs(from[axis] - to[axis]) > 2 * kPointError) continue;
      const std::int64_t at = std::llround(from[axis]);
      const GridPlane plane = WallPlane(axis, at);
      if (at % 2 != 0 && SideOf(plane, out_->points[edge.from]) == 0 &&
          SideOf(plane, out_->points[edge.to]) == 0) {
        bits |= 1 << axis;
      }
    }
    return bits;
  }

  // Calls visit(line) for each wall that the edge of a face of `side` lies in.
  // An edge of a face that lies in a wall itself runs where another one crosses
  // it, or is found once more on its other side, in C_cont.
  template <typename Visit>
  void ForEachLine(const SurfacePiece::Edge& edge, int side,
                   const Visit& visit) const {
    const GridPlane& own = out_->groups.planes[side / 2];
    for (int axis = 0; axis < 3; ++axis) {
      if ((edge.walls >> axis & 1) == 0) continue;
      WallLine wall;
      wall.axis = axis;
      wall.at = std::llround(out_->points.Approximate(edge.from)[axis]);
      GridPlane plane = own;
      if (IsWall(own) && own.normal[axis] != 0) {
        int other = 0;
        while (other < 3 && (other == axis || (edge.walls >> other & 1) == 0)) {
          ++other;
        }
        if (other == 3) continue;
        plane = WallPlane(
            other, std::llround(out_->points.Approximate(edge.from)[other]));
      }
      wall.line = plane;
      wall.line.offset -= plane.normal[axis] * wall.at;
      wall.line.normal[axis] = 0;
      wall.line = Coprime(wall.line);
      visit(wall);
    }
  }

  void FindLines() {
    for (const SurfacePiece::Face& f : faces_) {
      for (int h = f.begin; h < f.end; ++h) {
        ForEachLine(edges_[h], f.side, [&](const WallLine& wall) {
          std::vector<int>& points = lines_[wall];
          points.push_back(edges_[h].from);
          points.push_back(edges_[h].to);
        });
      }
    }
    for (auto& [wall, points] : lines_) {
      std::sort(points.begin(), points.end());
      points.erase(std::unique(points.begin(), points.end()), points.end());
      const int axis = AlongAxis(wall);
      std::sort(points.begin(), points.end(),
                [&](int a, int b) { return IsBefore(a, b, axis); });
    }
  }

  // In which the line varies.
  static int AlongAxis(const WallLine& wall) {
    const int u = (wall.axis + 1) % 3, v = (wall.axis + 2) % 3;
    return LargestAxis(wall.line.normal) == u ? v : u;
  }

  bool IsBefore(int a, int b, int axis) const {
    if (a == b) return false;
    const double difference =
        out_->points.Approximate(a)[axis] - out_->points.Approximate(b)[axis];
    if (std::abs(difference) > 2 * kPointError) return difference < 0.0;
    return CompareCoordinate(out_->points[a], out_->points[b], axis) < 0;
  }

  // Points of other edges on this one, from its start to its end.
  std::vector<int> InnerPoints(const SurfacePiece::Edge& edge, int side) const {
    std::vector<int> inner;
    int lines = 0;
    ForEachLine(edge, side, [&](const WallLine& wall) {
      const std::vector<int>& points = lines_.at(wall);
      const int axis = AlongAxis(wall);
      const bool forward = IsBefore(edge.from, edge.to, axis);
      const int low = forward ? edge.from : edge.to;
      const int high = forward ? edge.to : edge.from;
      const auto before = [&](int a, int b) { return IsBefore(a, b, axis); };
      const auto begin =
          std::upper_bound(points.begin(), points.end(), low, before);
      const auto end = std::lower_bound(begin, points.end(), high, before);
      inner.insert(inner.end(), begin, end);
      // The same points, or some of them, on the edge of two walls.
      if (lines++ > 0) {
        std::sort(inner.begin(), inner.end(), before);
        inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
      }
      if (!forward) std::reverse(inner.begin(), inner.end());
    });
    return inner;
  }

  JoinedSurface* out_;
  std::unordered_map<GridPlane, int, GridPlaneHash> planes_;
  std::vector<SurfacePiece::Edge> edges_;
  std::vector<SurfacePiece::Face> faces_;
  int cells_ = 0;              // thin ones
  std::vector<char> in_wall_;  // per half-edge of Split
  std::unordered_map<WallLine, std::vector<int>, WallLineHash> lines_;
};

}  // namespace

JoinedSurface JoinPieces(const std::vector<SurfacePiece>& pieces,
                         const AssemblyOptions& options) {
  assert(options.merge_coplanar && options.units_per_step == 2);
  JoinedSurface out;
  Joiner joiner(&out);
  for (const SurfacePiece& piece : pieces) joiner.Add(piece);
  const Arrangement faces = joiner.Take();
  if (faces.faces.empty()) {
    throw SurfaceError("contact space: no piece has a face");
  }
  // How far rays reach to find the outside.
  GridPoint far{};
  for (int id = 0; id < out.points.size(); ++id) {
    for (int k = 0; k < 3; ++k) {
      far[k] = std::max<std::int64_t>(
          far[k], std::llround(std::abs(out.points.Approximate(id)[k])) + 1);
    }
  }
  out.sides.points.push_back(far);
  const RadialEdges radial = SortAroundEdges(out.sides, faces, out.points);
  const FreeCells cells =
      FindCellsOfSurface(out.sides, faces, radial, out.points);
  for (int f = 0; f < static_cast<int>(faces.faces.size()); ++f) {
    if (!cells.side_is_free[PlusSide(f)] || cells.side_is_free[MinusSide(f)]) {
      throw LeakError("contact space: pieces do not fit together");
    }
  }
  out.cavities = cells.cavities;
  out.surface =
      AssembleSurface(faces, out.groups, radial, cells, options, &out.points);
  return out;
}

}  // namespace phongpd::internal
