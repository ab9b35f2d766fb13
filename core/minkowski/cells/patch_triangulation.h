// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/minkowski/cells/surface_assembly.h"

namespace phongpd::internal {

// The triangulated boundary of the free cells, before rounding.
struct ExactSurface {
  std::vector<int> vertex_points;  // ExactPoints id of each vertex
  // Nearest doubles to each vertex, grid steps.
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;  // outward: normals point into free space
  std::vector<int> facet;           // convolution facet of each triangle
};

// Triangulates every patch over its border vertices alone: constrained
// Delaunay with exact predicates; triangles and convex quadrilaterals, which
// are most patches, directly.  Throws std::logic_error when a border does not
// bound an area, which an arrangement cannot produce, and BuildRefusal when
// `limits`, if there are any, are passed.
ExactSurface TriangulatePatches(const PatchSurface& surface,
                                const Convolution& convolution,
                                const ExactPoints& points,
                                const BuildLimits* limits = nullptr);

}  // namespace phongpd::internal
