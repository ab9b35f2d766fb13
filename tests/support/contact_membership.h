// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>

#include "core/contact/contact_space.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd::testing {

// Do robot + q and obstacle meet?  Exact for the translated robot's rounded
// coordinates: proper crossings, or a component of one inside the other.
bool Meet(const TriangleMesh& robot, const TriangleMesh& obstacle,
          const Eigen::Vector3d& q);

// Compares membership in C_obj by winding number with Meet, at `count` points:
// half of them anywhere in the bounding box, half near b − a for vertices a of
// the robot and points b of the obstacle's surface (and the other way round),
// where thin parts of the operands are felt.  Points within 8 grid steps of
// the surface are passed over.  Returns a sentence on the first wrong point,
// or nothing.
std::string FindWrongPoint(const TriangleMesh& robot,
                           const TriangleMesh& obstacle,
                           const ContactSpace& space, int count,
                           std::mt19937_64* random);

}  // namespace phongpd::testing
