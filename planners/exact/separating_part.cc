// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/separating_part.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "constraints/translated_triangles.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Parts of a mesh that are connected through shared edges; −1 in `part` for
// those that are not closed.
std::vector<int> ClosedParts(const TriangleMesh& mesh, int* count) {
  const std::size_t n = mesh.triangles.size();
  std::vector<int> parent(n);
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      int& up = parent[static_cast<std::size_t>(i)];
      up = parent[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  };
  // Of each edge: passes from its lower to its higher end less those back, and
  // one of its triangles.  A part is closed when all of them cancel.
  std::map<std::pair<int, int>, std::pair<int, int>> edges;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
      if (a == b) continue;
      const int triangle = static_cast<int>(i);
      auto& [passes, first] =
          edges.try_emplace({std::min(a, b), std::max(a, b)}, 0, triangle)
              .first->second;
      passes += a < b ? 1 : -1;
      parent[static_cast<std::size_t>(find(triangle))] = find(first);
    }
  }
  std::vector<bool> is_open(n, false);
  for (const auto& [edge, use] : edges) {
    if (use.first != 0)
      is_open[static_cast<std::size_t>(find(use.second))] = true;
  }
  std::vector<int> number(n, -1), part(n);
  *count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto root = static_cast<std::size_t>(find(static_cast<int>(i)));
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
