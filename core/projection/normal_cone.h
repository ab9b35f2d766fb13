// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

// The cone of admissible normals at a vertex, {n : n·N_f ≥ c |n| for all f},
// where N_f are the unit normals of the incident facets.  For c ≥ 0 it is an
// intersection of circular cones, hence convex.  Zero N_f are ignored.
namespace phongpd {

// min_f n·N_f; 1 for an empty list.
double MinFacetDot(const Eigen::Vector3d& n,
                   const std::vector<Eigen::Vector3d>& facets);

// The unit direction that maximises min_f n·N_f: n = v/|v| with v the point of
// the convex hull of the N_f that is closest to the origin, and then
// min_f n·N_f = |v|.  Zero when the hull holds the origin (|v| ≤ 1e-9): no
// direction is in front of all facets.
Eigen::Vector3d BestNormal(const std::vector<Eigen::Vector3d>& facets);

// The smallest turn of unit n towards unit `base` (along their great circle)
// that makes min_f n·N_f ≥ c; `base` itself when it does not satisfy that
// either.  By bisection, which the convexity of the cone justifies.
Eigen::Vector3d LimitNormal(const Eigen::Vector3d& n,
                            const Eigen::Vector3d& base,
                            const std::vector<Eigen::Vector3d>& facets,
                            double c);

}  // namespace phongpd
