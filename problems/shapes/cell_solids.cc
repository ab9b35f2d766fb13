// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/shapes/cell_solids.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

#include "core/mesh/polygon_triangulation.h"
#include "core/solid/mesh_check.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The axis of an axis-aligned triangle's normal, and its sign.
struct Facing {
  int axis = 0;
  bool is_positive = false;

  bool operator==(const Facing& other) const {
    return axis == other.axis && is_positive == other.is_positive;
  }
};

Facing FacingOf(const TriangleMesh& mesh, const Triangle& t) {
  const Vector3d& a = mesh.vertices[t[0]];
  const Vector3d normal =
      (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
  Facing facing;
  normal.cwiseAbs().maxCoeff(&facing.axis);
  facing.is_positive = normal[facing.axis] > 0.0;
  return facing;
}

// A flat face: its outline counter-clockwise, holes clockwise.
struct FlatFace {
  Facing facing;
  std::vector<std::vector<int>> loops;
};

// The axis along which an edge between two vertices runs.
int EdgeAxis(const TriangleMesh& mesh, int a, int b) {
  int axis = 0;
  (mesh.vertices[b] - mesh.vertices[a]).cwiseAbs().maxCoeff(&axis);
  return axis;
}

// Faces are triangles joined over flat edges; what is left of their edges
// closes to loops.  No face if a border meets itself in a vertex, where a
// polygon would not be simple.
std::vector<FlatFace> FlatFaces(const TriangleMesh& mesh) {
  const std::vector<std::array<int, 3>> neighbors = TriangleNeighbors(mesh);
  const auto size = mesh.triangles.size();
  std::vector<char> is_done(size, 0);
  std::vector<FlatFace> faces;
  for (std::size_t seed = 0; seed < size; ++seed) {
    if (is_done[seed]) continue;
    FlatFace face;
    face.facing = FacingOf(mesh, mesh.triangles[seed]);
    std::map<int, int> next;  // along the border
    std::vector<std::size_t> front = {seed};
    is_done[seed] = 1;
    while (!front.empty()) {
      const std::size_t t = front.back();
      front.pop_back();
      const Triangle& corners = mesh.triangles[t];
      for (int k = 0; k < 3; ++k) {
        const auto other = static_cast<std::size_t>(neighbors[t][k]);
        if (!(FacingOf(mesh, mesh.triangles[other]) == face.facing)) {
          const int end = corners[(k + 1) % 3];
          if (!next.emplace(corners[k], end).second) return {};
        } else if (!is_done[other]) {
          is_done[other] = 1;
          front.push_back(other);
        }
      }
    }
    while (!next.empty()) {
      face.loops.emplace_back();
      for (auto at = next.begin(); at != next.end();
           at = next.find(face.loops.back().back())) {
        face.loops.back().push_back(at->second);
        next.erase(at);
      }
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

Vector2d InPlane(const Vector3d& p, const Facing& facing) {
  const double u = p[(facing.axis + 1) % 3], v = p[(facing.axis + 2) % 3];
  return facing.is_positive ? Vector2d(u, v) : Vector2d(v, u);
}

double Area(const std::vector<Vector2d>& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector2d& p = loop[i];
    const Vector2d& q = loop[(i + 1) % loop.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * twice;
}

}  // namespace

TriangleMesh UniteCells(const GridCuts& cuts,
                        const std::function<bool(int, int, int)>& is_solid) {
  using Cell = std::array<int, 3>;
  Cell size;
  for (int axis = 0; axis < 3; ++axis) {
    size[axis] = static_cast<int>(cuts[axis].size()) - 1;
  }
  const auto solid = [&](const Cell& c) {
    for (int axis = 0; axis < 3; ++axis) {
      if (c[axis] < 0 || c[axis] >= size[axis]) return false;
    }
    return is_solid(c[0], c[1], c[2]);
  };
  TriangleMesh mesh;
  std::map<Cell, int> index_of_corner;
  const auto vertex = [&](const Cell& corner) {
    const auto [at, is_new] =
        index_of_corner.emplace(corner, static_cast<int>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.emplace_back(cuts[0][corner[0]], cuts[1][corner[1]],
                                 cuts[2][corner[2]]);
    }
    return at->second;
  };
  // The face of `cell` towards `step` = ±1 along `axis`.
  const auto add_face = [&](const Cell& cell, int axis, int step) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Cell corner = cell;
    if (step > 0) ++corner[axis];
    std::array<int, 4> quad;
    quad[0] = vertex(corner);
    ++corner[u];
    quad[1] = vertex(corner);
    ++corner[v];
    quad[2] = vertex(corner);
    --corner[u];
    quad[3] = vertex(corner);
    if (step < 0) std::swap(quad[1], quad[3]);
    mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    mesh.triangles.push_back({quad[0], quad[2], quad[3]});
  };
  Cell cell;
  for (cell[0] = 0; cell[0] < size[0]; ++cell[0]) {
    for (cell[1] = 0; cell[1] < size[1]; ++cell[1]) {
      for (cell[2] = 0; cell[2] < size[2]; ++cell[2]) {
        if (!solid(cell)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int step : {-1, 1}) {
            Cell next = cell;
            next[axis] += step;
            if (!solid(next)) add_face(cell, axis, step);
          }
        }
      }
    }
  }
  return mesh;
}

TriangleMesh WithWholeFaces(const TriangleMesh& cells) {
  const MeshReport report = ExamineMesh(cells);
  if (report.boundary_edges + report.non_manifold_edges > 0) return cells;
  const std::vector<FlatFace> faces = FlatFaces(cells);
  if (faces.empty()) return cells;
  // A vertex stays where some border turns; then all faces see it.
  std::vector<char> is_corner(cells.vertices.size(), 0);
  for (const FlatFace& face : faces) {
    for (const std::vector<int>& loop : face.loops) {
      const std::size_t n = loop.size();
      for (std::size_t i = 0; i < n; ++i) {
        const int at = loop[i], next = loop[(i + 1) % n];
        const int previous = loop[(i + n - 1) % n];
        if (EdgeAxis(cells, previous, at) != EdgeAxis(cells, at, next)) {
          is_corner[at] = 1;
        }
      }
    }
  }

  TriangleMesh mesh;
  std::vector<int> index(cells.vertices.size(), -1);
  for (std::size_t v = 0; v < index.size(); ++v) {
    if (!is_corner[v]) continue;
    index[v] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(cells.vertices[v]);
  }
  for (const FlatFace& face : faces) {
    std::vector<std::pair<std::vector<int>, std::vector<Vector2d>>> loops;
    for (const std::vector<int>& loop : face.loops) {
      loops.emplace_back();
      for (const int v : loop) {
        if (!is_corner[v]) continue;
        loops.back().first.push_back(index[v]);
        loops.back().second.push_back(InPlane(cells.vertices[v], face.facing));
      }
      // The outline is the only loop of positive area.
      if (Area(loops.back().second) > 0.0) {
        std::swap(loops.front(), loops.back());
      }
    }
    std::vector<int> indices;
    std::vector<std::vector<Vector2d>> polygon;
    for (const auto& [numbers, points] : loops) {
      indices.insert(indices.end(), numbers.begin(), numbers.end());
      polygon.push_back(points);
    }
    for (const auto& [a, b, c] : TriangulatePolygon(polygon)) {
      mesh.triangles.push_back({indices[a], indices[b], indices[c]});
    }
  }
  return mesh;
}

}  // namespace phongpd::internal
