// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/projection/branch_walk.h"
#include "core/projection/field_projector.h"

namespace phongpd {

// The projection of x closest to the contact of `previous` among those on the
// triangles in `rings` rings of vertex neighbours around previous.triangle
// (paper, Algorithm 1 with the choice of section V.B).  Invalid if there is
// none.  Field frame; allocates.
Projection SearchRings(const FieldProjector& projector, const BranchWalk& walk,
                       const Eigen::Vector3d& x, const Projection& previous,
                       int rings);

// The walk of a warm query on the tangent-plane field, which has no closed
// form to follow: the move is cut until each part shifts the contact by no
// more than a few times the part's own length, and each part looks for the
// nearest contact in one ring.  Invalid where the branch ends.  Field frame;
// does not allocate.
Projection FollowByNewton(const FieldProjector& projector,
                          const BranchWalk& walk, const Eigen::Vector3d& x,
                          const Projection& previous) noexcept;

}  // namespace phongpd
