// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/cells/cell_probe.h"

#include <algorithm>

namespace phongpd::internal {
namespace {

// Faces of a cell from which a judging point is tried: the largest are the
// best, and the point farthest from any other face wins.
constexpr std::size_t kProbes = 4;

}  // namespace

Eigen::Vector3d ProbePoint(const FaceGeometry& geometry,
                           const std::vector<double>& area,
                           std::vector<int>* sides, double reach,
                           double* found_gap, int* found_face) {
  const std::size_t probes = std::min(kProbes, sides->size());
  std::partial_sort(
      sides->begin(), sides->begin() + probes, sides->end(),
      [&area](int a, int b) {
        return area[a / 2] != area[b / 2] ? area[a / 2] > area[b / 2] : a < b;
      });
  double best = -1.0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < probes; ++k) {
    const int face = (*sides)[k] / 2;
    const Eigen::Vector3d from = geometry.InteriorPoint(face);
    const Eigen::Vector3d n = geometry.Normal(face);
    const double gap = geometry.FirstHit(from, n, 0.02 * reach, face).distance;
    if (gap > best) {
      best = gap;
      if (found_face != nullptr) *found_face = face;
      point = from + 0.41283 * gap * n;
    }
  }
  if (found_gap != nullptr) *found_gap = best;
  return point;
}

}  // namespace phongpd::internal
