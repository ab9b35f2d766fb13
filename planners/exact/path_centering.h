// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/projection/contact_surface.h"

namespace phongpd {

// Gives a path that meets no surface the clearance its passages have: where it
// is nearer than `clearance`, points move away from the surface until that is
// reached or the gap is halved, and a segment that dips below its ends gets a
// point there.  A move counts if both segments stay free, by exact tests, and
// the lesser of their clearances does not fall.  Ends stay.  `kept` > 0: a
// segment counts as dipping where it has less than that, too.
void CenterPath(const ContactSurface& surface, const TriangleBvh& segments,
                double clearance, double kept,
                std::vector<Eigen::Vector3d>* path);

}  // namespace phongpd
