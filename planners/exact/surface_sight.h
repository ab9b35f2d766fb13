// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/triangle_mesh.h"
#include "planners/exact/surface_graph.h"

namespace phongpd {

// The place p where a straight way from q ends on the surface (up to rounding;
// free before that) as a site that may be lifted towards q.
//
// Its triangle faces q, exactly.  That is not a matter of course: of the
// triangles that meet in an edge at p some may be seen from behind.  The free
// sector at an edge is at most 360°, q lies in it, so one of its two sides is
// less than 180° away: it faces q and nothing is between; of those that face q
// the steepest is taken.  At a corner, and where solids touch each other, other
// triangles may still be in between.  There the site is moved into a triangle
// that faces q, so far that q sees it.  Nothing if no such place was found.
// Where q is p, to the last bit, the site has no direction: it is zero.
std::optional<SurfaceSite> SiteSeenFrom(const Eigen::Vector3d& q,
                                        const Eigen::Vector3d& p, int triangle,
                                        const TriangleMesh& mesh,
                                        const TriangleBvh& segments,
                                        double rounding);

}  // namespace phongpd
