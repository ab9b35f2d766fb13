// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/separating_part.h"

#include <algorithm>
#include <array>
#include <map>

#include "constraints/translated_triangles.h"
#include "core/mesh/union_find.h"
#include "planners/exact/free_neighbors.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// A number for each vertex, the same for those at one place.
std::vector<int> Places(const std::vector<Vector3d>& vertices) {
  std::map<std::array<double, 3>, int> numbers;
  std::vector<int> places;
  places.reserve(vertices.size());
  for (const Vector3d& v : vertices) {
    places.push_back(numbers
                         .emplace(std::array<double, 3>{v[0], v[1], v[2]},
                                  static_cast<int>(numbers.size()))
                         .first->second);
  }
  return places;
}

// Parts of a mesh that are connected through edges, those of one side where two
// touch; −1 in `part` for those that are not closed.  Which triangles go
// together is nothing to rely on: any part that is closed may separate.
std::vector<int> ClosedParts(const TriangleMesh& mesh, int* count) {
  const std::size_t n = mesh.triangles.size();
  internal::UnionFind parts(n);
  const std::vector<std::array<int, 3>> neighbors = FreeNeighbors(mesh);
  for (std::size_t i = 0; i < n; ++i) {
    for (const int other : neighbors[i]) {
      if (other >= 0) parts.Join(static_cast<int>(i), other);
    }
  }
  // Of each segment in a part: passes from its lower to its higher end less
  // those back.  A part is closed when all of them cancel.
  const std::vector<int> places = Places(mesh.vertices);
  std::map<std::array<int, 3>, int> passes;
  for (std::size_t i = 0; i < n; ++i) {
    const int part = parts.Find(static_cast<int>(i));
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = places[static_cast<std::size_t>(mesh.triangles[i][k])];
      const int b =
          places[static_cast<std::size_t>(mesh.triangles[i][(k + 1) % 3])];
      if (a == b) continue;
      passes[{part, std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  std::vector<bool> is_open(n, false);
  for (const auto& [segment, sum] : passes) {
    if (sum != 0) is_open[static_cast<std::size_t>(segment[0])] = true;
  }
  std::vector<int> number(n, -1), part(n);
  *count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto root = static_cast<std::size_t>(parts.Find(static_cast<int>(i)));
    if (number[root] < 0 && !is_open[root]) number[root] = (*count)++;
    part[i] = number[root];
  }
  return part;
}

}  // namespace

std::vector<int> FindSeparatingPart(const TriangleMesh& mesh,
                                    const Vector3d& one,
                                    const Vector3d& other) {
  int count = 0;
  const std::vector<int> part = ClosedParts(mesh, &count);
  // Winding numbers of each part around one point less those around the other.
  std::vector<int> difference(static_cast<std::size_t>(count), 0);
  std::vector<std::vector<int>> triangles(difference.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part[i] < 0) continue;
    const auto p = static_cast<std::size_t>(part[i]);
    triangles[p].push_back(static_cast<int>(i));
    internal::Corners t;
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
    }
    if (internal::IsDegenerate(t)) continue;
    const Vector3d zero = Vector3d::Zero();
    difference[p] += internal::UpwardCrossing(t, one, zero, 1) -
                     internal::UpwardCrossing(t, other, zero, 1);
  }
  std::vector<int> smallest;
  for (std::size_t p = 0; p < triangles.size(); ++p) {
    if (difference[p] == 0) continue;
    if (smallest.empty() || triangles[p].size() < smallest.size()) {
      smallest = triangles[p];
    }
  }
  return smallest;
}

}  // namespace phongpd
