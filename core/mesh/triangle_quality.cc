// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/triangle_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace phongpd {

double TriangleQuality(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       const Eigen::Vector3d& c) noexcept {
  const Eigen::Vector3d ab = b - a, ac = c - a, bc = c - b;
  const double edges = ab.squaredNorm() + ac.squaredNorm() + bc.squaredNorm();
  if (!(edges > 0.0)) return 0.0;
  // stableNorm: squares of areas overflow from lengths of 1e77 on.
  return 2.0 * std::sqrt(3.0) * ab.cross(ac).stableNorm() / edges;
}

QualityFigures MeasureQuality(const TriangleMesh& mesh) {
  std::vector<double> all;
  all.reserve(mesh.triangles.size());
  for (const auto& [i, j, k] : mesh.triangles) {
    all.push_back(
        TriangleQuality(mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]));
  }
  if (all.empty()) return {};
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return {*std::min_element(all.begin(), middle + 1), *middle};
}

}  // namespace phongpd
