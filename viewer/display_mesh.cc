// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/display_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <vector>

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr double kMostCells = 1 << 20;  // along an axis: three fit 63 bits

TriangleMesh Clustered(const TriangleMesh& mesh, const BoundingBox& box,
                       double cell) {
  std::unordered_map<std::int64_t, int> cells;
  std::vector<int> cluster(mesh.vertices.size(), -1);
  std::vector<int> members;
  TriangleMesh result;
  std::set<Triangle> seen;
  const auto cluster_of = [&](int v) {
    int& c = cluster[static_cast<std::size_t>(v)];
    if (c >= 0) return c;
    const Vector3d& p = mesh.vertices[static_cast<std::size_t>(v)];
    const Vector3d at = (p - box.min) / cell;
    std::int64_t key = 0;
    for (int k = 0; k < 3; ++k) {
      key = key * (std::int64_t{1} << 21) +
            static_cast<std::int64_t>(std::min(at[k], kMostCells));
    }
    c = cells.emplace(key, static_cast<int>(members.size())).first->second;
    if (c == static_cast<int>(members.size())) {
      members.push_back(0);
      result.vertices.push_back(Vector3d::Zero());
    }
    const auto i = static_cast<std::size_t>(c);
    ++members[i];
    // A running mean: sums might overflow.
    result.vertices[i] += (p - result.vertices[i]) / members[i];
    return c;
  };
  for (const Triangle& t : mesh.triangles) {
    Triangle image = {cluster_of(t[0]), cluster_of(t[1]), cluster_of(t[2])};
    if (image[0] == image[1] || image[1] == image[2] || image[2] == image[0]) {
      continue;
    }
    std::rotate(image.begin(), std::min_element(image.begin(), image.end()),
                image.end());
    if (seen.insert(image).second) result.triangles.push_back(image);
  }
  return result;
}

}  // namespace

DisplayMesh MeshForDisplay(const TriangleMesh& mesh, std::size_t most) {
  if (mesh.triangles.size() <= most) return {mesh, 0.0};
  const BoundingBox box = ComputeBounds(mesh);
  const double extent = (box.max - box.min).maxCoeff();
  // A surface of area 2·extent² has about four triangles a cell it crosses.
  double cells = std::sqrt(static_cast<double>(most)) / 2.0;
  for (; cells >= 1.0; cells *= 0.8) {
    const double cell = extent / cells;
    TriangleMesh coarse = Clustered(mesh, box, cell);
    if (coarse.triangles.size() <= most) return {std::move(coarse), cell};
  }
  return {TriangleMesh(), extent};
}

}  // namespace phongpd
