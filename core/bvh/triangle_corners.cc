// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/triangle_corners.h"

#include <cstddef>
#include <utility>

namespace phongpd {

std::vector<TriangleCorners> CornersOf(const TriangleMesh& mesh) {
  std::vector<TriangleCorners> corners;
  corners.reserve(mesh.triangles.size());
  for (const auto& [i, j, k] : mesh.triangles) {
    corners.push_back({mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]});
  }
  return corners;
}

BoxTree SortIntoTree(std::vector<TriangleCorners>* corners) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(corners->size());
  for (const auto& [a, b, c] : *corners) {
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  BoxTree tree(boxes, 2);
  std::vector<TriangleCorners> sorted;
  sorted.reserve(corners->size());
  for (const int item : tree.order()) sorted.push_back((*corners)[item]);
  *corners = std::move(sorted);
  return tree;
}

}  // namespace phongpd
