// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/sorted_mesh.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/mesh/numbers.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

using internal::At;

}  // namespace

SortedMesh SortByCoordinates(const TriangleMesh& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) used[At(v)] = 1;
  }
  std::vector<int> order;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) order.push_back(static_cast<int>(v));
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const Vector3d& p = mesh.vertices[At(a)];
    const Vector3d& q = mesh.vertices[At(b)];
    for (int k = 0; k < 3; ++k) {
      if (p[k] != q[k]) return p[k] < q[k];
    }
    return a < b;
  });
  SortedMesh result;
  std::vector<int> rank(mesh.vertices.size(), -1);
  result.mesh.vertices.reserve(order.size());
  for (const int v : order) {
    rank[At(v)] = static_cast<int>(result.mesh.vertices.size());
    result.mesh.vertices.push_back(mesh.vertices[At(v)]);
  }
  std::vector<std::pair<Triangle, int>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle triangle = mesh.triangles[t];
    for (int& v : triangle) v = rank[At(v)];
    std::rotate(triangle.begin(),
                std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    triangles.emplace_back(triangle, static_cast<int>(t));
  }
  std::sort(triangles.begin(), triangles.end());
  for (const auto& [triangle, input] : triangles) {
    result.mesh.triangles.push_back(triangle);
    result.source.push_back(input);
  }
  return result;
}

}  // namespace phongpd
