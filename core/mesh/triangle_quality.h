// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// Quality of a triangle, 4√3 · area / (sum of the squared edges): 1 when
// equilateral, 0 when degenerate; scale-free.  A needle or cap of height
// ε · longest edge has about 1.7 ε (needle) to 2.3 ε (flat cap).
// Coordinates within 1e±80.
double TriangleQuality(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       const Eigen::Vector3d& c) noexcept;

struct QualityFigures {
  double worst = 0.0;
  double median = 0.0;
};

// Over the triangles of a mesh, each counting once; zeros when it has none.
QualityFigures MeasureQuality(const TriangleMesh& mesh);

}  // namespace phongpd
