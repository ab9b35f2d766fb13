// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/minkowski/arrangement/face_geometry.h"

namespace phongpd::internal {

// A point well inside the cell that `sides` look into, all of them + sides, at
// most 1 % of `reach` away from the largest; puts those first.  `area` is that
// of each face.  `gap` and `face`, if given: how far the cell goes on there,
// and before which face that is.
Eigen::Vector3d ProbePoint(const FaceGeometry& geometry,
                           const std::vector<double>& area,
                           std::vector<int>* sides, double reach,
                           double* gap = nullptr, int* face = nullptr);

}  // namespace phongpd::internal
