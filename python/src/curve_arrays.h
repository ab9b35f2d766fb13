// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "constraints/trajectory.h"
#include "python/src/arrays.h"

// Curves in time as the Python files hand them over.
namespace phongpd::python {

using Seconds =
    nb::ndarray<const double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

// Of as many Bézier points a piece as there are for each duration, of which
// there is one; joined, by moving it by `moved`.
inline Trajectory JoinedCurve(const Seconds& durations, const Rows3& points,
                              double* moved) {
  const size_t pieces = durations.shape(0);
  const size_t width = points.shape(0) / pieces;
  std::vector<CurvePiece> curve;
  curve.reserve(pieces);
  std::vector<Eigen::Vector3d> own(width);
  for (size_t i = 0; i < pieces; ++i) {
    for (size_t k = 0; k < width; ++k) own[k] = Row(points, i * width + k);
    curve.emplace_back(own, durations(i));
  }
  return Trajectory::Joined(std::move(curve), moved);
}

}  // namespace phongpd::python
