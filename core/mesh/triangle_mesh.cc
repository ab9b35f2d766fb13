// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/mesh/union_find.h"

namespace phongpd {

BoundingBox ComputeBounds(const TriangleMesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  BoundingBox box{Eigen::Vector3d::Constant(kInfinity),
                  Eigen::Vector3d::Constant(-kInfinity)};
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) {
      box.min = box.min.cwiseMin(mesh.vertices[v]);
      box.max = box.max.cwiseMax(mesh.vertices[v]);
    }
  }
  return box;
}

double SignedVolume(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0.0;
  const Eigen::Vector3d center = ComputeBounds(mesh).Center();
  double six_volumes = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[i] - center;
    const Eigen::Vector3d b = mesh.vertices[j] - center;
    const Eigen::Vector3d c = mesh.vertices[k] - center;
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

double SurfaceArea(const TriangleMesh& mesh) {
  double twice_area = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[i];
    const Eigen::Vector3d ab = mesh.vertices[j] - a;
    const Eigen::Vector3d ac = mesh.vertices[k] - a;
    // Plain norms of areas overflow from lengths of 1e77 on.
    twice_area += ab.cross(ac).stableNorm();
  }
  return 0.5 * twice_area;
}

std::vector<int> LabelComponents(const TriangleMesh& mesh, int* count) {
  internal::UnionFind sets(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.Join(a, b);
    sets.Join(b, c);
  }
  std::vector<int> label_of_root(mesh.vertices.size(), -1);
  std::vector<int> labels;
  labels.reserve(mesh.triangles.size());
  *count = 0;
  for (const Triangle& triangle : mesh.triangles) {
    int& label = label_of_root[sets.Find(triangle[0])];
    if (label < 0) label = (*count)++;
    labels.push_back(label);
  }
  return labels;
}

std::vector<std::array<int, 3>> TriangleNeighbors(const TriangleMesh& mesh) {
  struct HalfEdge {
    int low, high;  // its end points, sorted: the two sides of an edge match
    int triangle, corner;
  };
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] =
          std::minmax({mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]});
      half_edges.push_back({low, high, static_cast<int>(t), k});
    }
  }
  // Sorted rather than hashed: no bad case for vertices of high valence.
  std::sort(half_edges.begin(), half_edges.end(),
            [](const HalfEdge& a, const HalfEdge& b) {
              return a.low != b.low ? a.low < b.low : a.high < b.high;
            });
  std::vector<std::array<int, 3>> neighbors(mesh.triangles.size(),
                                            {-1, -1, -1});
  for (std::size_t i = 0; i + 1 < half_edges.size(); ++i) {
    const HalfEdge& a = half_edges[i];
    const HalfEdge& b = half_edges[i + 1];
    if (a.low != b.low || a.high != b.high) continue;
    neighbors[a.triangle][a.corner] = b.triangle;
    neighbors[b.triangle][b.corner] = a.triangle;
  }
  return neighbors;
}

TriangleMesh Reversed(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh Translated(TriangleMesh mesh, const Eigen::Vector3d& offset) {
  for (Eigen::Vector3d& v : mesh.vertices) v += offset;
  return mesh;
}

TriangleMesh Scaled(TriangleMesh mesh, double factor) {
  for (Eigen::Vector3d& v : mesh.vertices) v *= factor;
  return mesh;
}

TriangleMesh Rotated(TriangleMesh mesh, const Eigen::Matrix3d& rotation) {
  for (Eigen::Vector3d& v : mesh.vertices) v = rotation * v;
  return mesh;
}

TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh = a;
  const int offset = static_cast<int>(a.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(),
                       b.vertices.end());
  for (const auto& [i, j, k] : b.triangles) {
    mesh.triangles.push_back({i + offset, j + offset, k + offset});
  }
  return mesh;
}

}  // namespace phongpd
