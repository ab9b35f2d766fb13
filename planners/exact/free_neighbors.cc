// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/free_neighbors.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/bvh/exact_sign.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// For each vertex the first one at the same place.
std::vector<int> FirstCopies(const std::vector<Vector3d>& vertices) {
  const auto key = [&](int v) {
    const Vector3d& p = vertices[v];
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  std::vector<int> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return key(a) < key(b); });
  std::vector<int> first(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool copy = i > 0 && key(order[i - 1]) == key(order[i]);
    first[order[i]] = copy ? first[order[i - 1]] : order[i];
  }
  return first;
}

// Edge k of a triangle, from corner k to the next.
struct Side {
  int triangle;
  std::size_t k;
};

class Sectors {
 public:
  explicit Sectors(const TriangleMesh& mesh) : mesh_(mesh) {}

  // Of the sides of one segment the one met first when `side`'s triangle turns
  // about it towards its front.
  const Side& FirstInFront(const Side& side,
                           const std::vector<Side>& sides) const {
    const Side* first = nullptr;
    for (const Side& other : sides) {
      if (other.triangle == side.triangle) continue;
      if (first == nullptr || IsBefore(side, other, *first)) first = &other;
    }
    return *first;
  }

 private:
  const Vector3d& Corner(const Side& side, std::size_t i) const {
    return mesh_.vertices[mesh_.triangles[side.triangle][(side.k + i) % 3]];
  }
  int Sign(const Side& side, const Vector3d& apex, const Vector3d& p) const {
    return Orient3d(Corner(side, 0).data(), Corner(side, 1).data(), apex.data(),
                    p.data());
  }
  bool IsBefore(const Side& side, const Side& a, const Side& b) const {
    const Vector3d &p = Corner(a, 2), &q = Corner(b, 2);
    // Less than half a turn, half a turn, more.
    const int at_p = Sign(side, Corner(side, 2), p);
    const int at_q = Sign(side, Corner(side, 2), q);
    return at_p != at_q ? at_p > at_q : Sign(side, p, q) > 0;
  }

  const TriangleMesh& mesh_;
};

}  // namespace

std::vector<std::array<int, 3>> FreeNeighbors(const TriangleMesh& mesh) {
  std::vector<std::array<int, 3>> neighbors = TriangleNeighbors(mesh);
  const std::vector<int> first = FirstCopies(mesh.vertices);
  std::vector<char> is_copied(mesh.vertices.size(), 0);
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] != static_cast<int>(v)) is_copied[v] = is_copied[first[v]] = 1;
  }
  std::map<std::pair<int, int>, std::vector<Side>> segments;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k];
      const int b = mesh.triangles[t][(k + 1) % 3];
      if (is_copied[a] == 0 && is_copied[b] == 0) continue;
      segments[{std::min(first[a], first[b]), std::max(first[a], first[b])}]
          .push_back({static_cast<int>(t), k});
    }
  }
  const Sectors sectors(mesh);
  for (const auto& segment : segments) {
    const std::vector<Side>& sides = segment.second;
    if (sides.size() <= 2) continue;
    // Facets folded onto each other have no order: they stay as they are.
    const bool is_mutual =
        std::all_of(sides.begin(), sides.end(), [&](const Side& side) {
          const Side& other = sectors.FirstInFront(side, sides);
          return sectors.FirstInFront(other, sides).triangle == side.triangle;
        });
    if (!is_mutual) continue;
    for (const Side& side : sides) {
      neighbors[side.triangle][side.k] =
          sectors.FirstInFront(side, sides).triangle;
    }
  }
  return neighbors;
}

}  // namespace phongpd
