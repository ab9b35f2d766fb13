// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace phongpd {

class TriangleBvh;
struct SurfaceSite;

struct LiftCounts;  // contact_surface_planner.h

// How far a site can be lifted: min(clearance, half the free gap in front).
double RoomAbove(const SurfaceSite& site, const TriangleBvh& segments,
                 double clearance, double rounding);

// Lifts a route off the surface: every site moves along its direction by
// min(clearance, half the free gap there), and while a segment is blocked the
// larger lift of its two ends is halved (halving both would lose the
// clearance that a passage has).  Sites without direction stay.  A segment
// that is free but leaves less than half of what its ends have been lifted by
// counts as blocked too, until its lifts are an eighth of the smaller first
// one: so a segment into a passage does not graze its rim.
//
// Complete: for each segment there is an ε so that it is free whenever both
// its ends are lifted by at most ε, in any ratio (planners/README.md); no lift
// falls below half the smallest of these.
//
// Returns nothing with all segments free of contact by exact tests; *path then
// holds the points.  Otherwise the lifts became as small as rounding allows,
// and the segments, point k → point k + 1, that are to blame are returned:
// those which no lift of their own frees, or else the one that needs the
// smallest.  (Not the one at which lifts vanished: the lifts of its neighbours
// vanish with those of a segment that stays blocked.)  Sites lie on the surface
// within `rounding`, 2⁻⁴⁶ of the largest coordinate.
std::vector<int> LiftRoute(const std::vector<SurfaceSite>& sites,
                           const TriangleBvh& segments, double clearance,
                           double rounding, std::vector<Eigen::Vector3d>* path,
                           LiftCounts* counts);

}  // namespace phongpd
