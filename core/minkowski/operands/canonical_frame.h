// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// A rotation in which as much facet area as possible is axis-aligned, or the
// identity.
//
// Solids that were modelled axis-aligned and then turned together have facets
// that are coplanar, or parallel, up to rounding only.  Turned back,
// coordinates that agree up to rounding become one (grid_frame.h), and
// thousands of slivers never arise (two wrenches turned alike: minutes to
// tenths of a second). Turning rounds, so it is not for what lies on a lattice
// as it is.  The frame is built from the facet direction with the largest share
// of both operands' area and the largest one perpendicular to it, and is used
// only when it raises the axis-aligned share of the area.
struct CanonicalFrame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // user → frame
  bool used = false;
};

CanonicalFrame ChooseCanonicalFrame(const TriangleMesh& robot,
                                    const TriangleMesh& obstacle);

}  // namespace phongpd::internal
