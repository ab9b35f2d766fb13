// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/path_resampling.h"

#include <cmath>
#include <queue>
#include <string>
#include <utility>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {

using Eigen::Vector3d;

std::vector<Vector3d> ResampleKeepingCorners(
    const std::vector<Vector3d>& corners, int waypoints) {
  std::vector<Vector3d> path;
  if (corners.size() < 2 || waypoints + 2 < static_cast<int>(corners.size())) {
    return path;
  }
  for (const Vector3d& corner : corners) {
    if (!IsFinite(corner)) {
      throw InputError("resampling: expected finite points, found NaN or Inf");
    }
  }
  // Give pieces, one by one, to the segment whose pieces are longest; of equal
  // ones to the last.
  const std::size_t segments = corners.size() - 1;
  std::vector<int> pieces(segments, 1);
  std::vector<double> length(segments);
  std::priority_queue<std::pair<double, std::size_t>> longest;
  for (std::size_t k = 0; k < segments; ++k) {
    length[k] = (corners[k + 1] - corners[k]).norm();
    if (!std::isfinite(length[k])) {
      throw InputError(
          "resampling: expected points less than 1e154 apart, found more after "
          "point " +
          std::to_string(k) + " (from 0); use another unit");
    }
    longest.push({length[k], k});
  }
  for (int left = waypoints + 1 - static_cast<int>(segments); left > 0;
       --left) {
    const std::size_t k = longest.top().second;
    longest.pop();
    ++pieces[k];
    longest.push({length[k] / pieces[k], k});
  }
  for (std::size_t k = 0; k < segments; ++k) {
    for (int i = 0; i < pieces[k]; ++i) {
      const double share = static_cast<double>(i) / pieces[k];
      path.push_back(corners[k] + share * (corners[k + 1] - corners[k]));
    }
  }
  path.push_back(corners.back());
  return path;
}

}  // namespace phongpd
