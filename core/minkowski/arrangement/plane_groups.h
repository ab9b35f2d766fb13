// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/operands/exact_points.h"

namespace phongpd::internal {

// Convolution facets by their supporting plane.  Facets of one plane, facing
// either way, are subdivided together and never intersected with each other:
// on coplanar input this is what keeps the arrangement small (contact-space
// figures in results/).
struct PlaneGroups {
  std::vector<int> of_facet;   // group of each facet
  std::vector<char> reversed;  // facet normal opposes the group's
  std::vector<std::vector<int>> members;
  // Coprime coefficients, first non-zero component of the normal positive.
  std::vector<GridPlane> planes;
};

// Exact: planes are compared by their reduced integer coefficients.  Groups
// are numbered by first appearance.
PlaneGroups GroupByPlane(const Convolution& convolution);

// The same plane with coprime normal and offset, the first non-zero component
// of the normal positive; one in which only two coordinates matter is a line of
// a coordinate plane.  The normal is not zero.
GridPlane Coprime(GridPlane plane);

}  // namespace phongpd::internal
