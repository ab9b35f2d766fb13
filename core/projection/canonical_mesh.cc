// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/canonical_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/projection/edge_split.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

std::size_t At(int k) { return static_cast<std::size_t>(k); }

[[noreturn]] void Refuse(const std::string& what) {
  throw InputError("Phong field: expected " + what);
}

void CheckMesh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) Refuse("triangles, found none");
  std::size_t bad = 0;
  const int n = static_cast<int>(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) bad += v < 0 || v >= n ? 1 : 0;
  }
  if (bad > 0) {
    Refuse("vertex indices in [0, " + std::to_string(n) + "), found " +
           std::to_string(bad) + " others");
  }
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) bad += IsFinite(mesh.vertices[At(v)]) ? 0 : 1;
  }
  if (bad > 0) {
    Refuse("finite vertices, found " + std::to_string(bad) +
           " triangle corners that are not");
  }
  MakeEdgeTable(mesh.triangles, &bad);
  if (bad > 0) {
    Refuse("a closed, consistently oriented surface, found " +
           std::to_string(bad) +
           " edges that do not have one triangle on each side");
  }
}

}  // namespace

CanonicalMesh MakeCanonical(const TriangleMesh& mesh) {
  CheckMesh(mesh);
  const BoundingBox box = ComputeBounds(mesh);
  const double diagonal = box.Diagonal();
  int exponent = 0;
  std::frexp(diagonal, &exponent);
  CanonicalMesh result;
  result.center = box.Center();
  result.scale = std::ldexp(1.0, 1 - exponent);
  result.diagonal = diagonal * result.scale;
  if (!std::isnormal(diagonal) || !std::isnormal(result.scale)) {
    Refuse("a bounding box of finite, positive diagonal, found " +
           std::to_string(diagonal));
  }

  std::vector<char> used(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) used[At(v)] = 1;
  }
  std::vector<Vector3d> points(mesh.vertices.size());
  std::vector<int> order;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!used[v]) continue;
    points[v] = (mesh.vertices[v] - result.center) * result.scale;
    order.push_back(static_cast<int>(v));
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const Vector3d& p = points[At(a)];
    const Vector3d& q = points[At(b)];
    for (int k = 0; k < 3; ++k) {
      if (p[k] != q[k]) return p[k] < q[k];
    }
    return a < b;
  });
  std::vector<int> rank(points.size(), -1);
  result.mesh.vertices.reserve(order.size());
  for (const int v : order) {
    rank[At(v)] = static_cast<int>(result.mesh.vertices.size());
    result.mesh.vertices.push_back(points[At(v)]);
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
