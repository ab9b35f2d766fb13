// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

#include "core/mesh/edge_sides.h"
#include "core/mesh/numbers.h"
#include "core/mesh/union_find.h"

namespace phongpd {

BoundingBox ComputeBounds(const TriangleMesh& mesh) {
  using internal::kInfinity;
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
  using internal::EdgeSide;
  const std::vector<EdgeSide> sides = internal::SortedEdgeSides(
      mesh.triangles, internal::FoldedTriangles::kKept);
  std::vector<std::array<int, 3>> neighbors(mesh.triangles.size(),
                                            {-1, -1, -1});
  internal::ForEachEdge(sides, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin + 1; i < end; ++i) {
      const EdgeSide &a = sides[i - 1], &b = sides[i];
      neighbors[a.triangle][a.corner] = b.triangle;
      neighbors[b.triangle][b.corner] = a.triangle;
    }
  });
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
