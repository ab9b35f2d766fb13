// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "constraints/free_space.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd::internal {

// n · (Σ_j w_j B_j) is `gap` above the plane that keeps one point of the hull
// of a part of a piece from the triangles, or the bound, below it.
struct ClearanceRow {
  Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Zero();
  int first = 0, last = 0;  // of the weights that are not 0
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit
  double gap = 0.0;                                  // > 0
  double distance = 0.0;  // the least gap of the part's points
};

struct PieceCells {
  std::vector<ClearanceRow> rows;
  double distance = 0.0;  // the least, or infinity
  int planes = 0;
};

// Half-spaces for the Bézier points of a free piece, that keep it free
// wherever its points move within them, each coordinate by at most `trust`:
// those of the judge's proof (curve_judge.h), so that a piece is parted where
// its hull is not clear of contact.  Only those that a point can come closer
// to than `wanted`.
PieceCells FindCells(const FreeSpace& space, const KnotCurve::Points& points,
                     double trust, double wanted);

}  // namespace phongpd::internal
