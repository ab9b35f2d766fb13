// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

using WideReal = long double;

// 6 V of every group of facets, relative to a vertex of it: a small group's
// differences are small, so that rounding does not reach its sign.
template <typename Points>
std::vector<WideReal> Volumes(const Points& vertices,
                              const std::vector<Triangle>& facets,
                              const std::vector<int>& groups, int count) {
  std::vector<WideReal> volumes(count, 0);
  std::vector<int> origin(count, -1);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    int& o = origin[groups[f]];
    if (o < 0) o = facets[f][0];
    WideReal e[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        e[i][k] =
            WideReal(vertices[facets[f][i]][k]) - WideReal(vertices[o][k]);
      }
    }
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      volumes[groups[f]] += e[0][k] * (e[1][l] * e[2][m] - e[1][m] * e[2][l]);
    }
  }
  return volumes;
}

// Of every vertex that a triangle uses, the label of its component.
inline std::vector<int> ComponentsOfVertices(const TriangleMesh& mesh,
                                             const std::vector<int>& labels) {
  std::vector<int> components(mesh.vertices.size(), -1);
  for (std::size_t f = 0; f < labels.size(); ++f) {
    for (const int v : mesh.triangles[f]) components[v] = labels[f];
  }
  return components;
}

}  // namespace phongpd::internal
