// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/contact_kind.h"
#include "core/minkowski/contact_space_options.h"
#include "core/minkowski/contact_space_report.h"

namespace phongpd {

// C_cont = ∂C_obj with C_obj = B ⊕ (−A), the boundary of all robot positions
// q for which A + q and B meet; closed, outward, bounded free cavities
// included as inward shells.  Topology is exact; coordinates are the exact
// vertices rounded to double.
struct ContactSpace {
  TriangleMesh mesh;
  // Supporting plane of each triangle: triangles with equal id lie exactly in
  // one oriented plane.
  std::vector<int> plane;
  std::vector<ContactKind> kind;  // of each triangle
  ContactSpaceReport report;
};

// Builds the contact space of a translating `robot` (A) and a fixed
// `obstacle` (B) by reduced convolution on an integer grid, exact arrangement
// per supporting plane, and one collision judgement per candidate cell
// (design and references: core/README.md).  Operands may have any genus and
// several, even overlapping, components.
//
// Both operands go through RepairSolid first: inside-out components are turned
// and said in the report, anything unusable throws InputError; with the
// default options nothing else is changed.  Throws
// std::logic_error if the arrangement leaks (the unbounded cell turns out
// occupied), which no valid input should cause.
ContactSpace BuildContactSpace(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const ContactSpaceOptions& options = {});

}  // namespace phongpd
