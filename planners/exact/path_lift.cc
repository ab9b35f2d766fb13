// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/path_lift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/triangle_bvh.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/surface_graph.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// The larger lift of the two ends with which the segment between them becomes
// free when nothing else holds it; 0 if none above `least` does, infinity if it
// is free and has no lift to lose.
double FreeLift(const SurfaceSite& a, const SurfaceSite& b, double lift_a,
                double lift_b, double least, const TriangleBvh& segments) {
  while (segments.Meets(a.point + lift_a * a.direction,
                        b.point + lift_b * b.direction)) {
    double& larger = lift_a > lift_b ? lift_a : lift_b;
    if (!(larger > least)) return 0.0;
    larger *= 0.5;
  }
  const double lift = std::max(lift_a, lift_b);
  return lift > 0.0 ? lift : std::numeric_limits<double>::infinity();
}

std::vector<int> SegmentsToBlame(const std::vector<SurfaceSite>& sites,
                                 const std::vector<double>& first_lift,
                                 double least, const TriangleBvh& segments) {
  std::vector<int> blamed;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < sites.size(); ++k) {
    const double lift = FreeLift(sites[k], sites[k + 1], first_lift[k],
                                 first_lift[k + 1], least, segments);
    if (lift < smallest) blamed.clear();
    if (lift < smallest || lift == 0.0) blamed.push_back(static_cast<int>(k));
    smallest = std::min(smallest, lift);
  }
  return blamed;
}

}  // namespace

double RoomAbove(const SurfaceSite& site, const TriangleBvh& segments,
                 double clearance, double rounding) {
  // Half the gap is less than the clearance only if something is nearer than
  // twice the clearance.
  return clearance *
         FirstAbove(site, segments, 2.0 * clearance, rounding).fraction;
}

std::vector<int> LiftRoute(const std::vector<SurfaceSite>& sites,
                           const TriangleBvh& segments, double clearance,
                           double rounding, std::vector<Vector3d>* path,
                           LiftCounts* counts) {
  // Below an ulp of the coordinates nothing moves any more.
  const double least = std::ldexp(rounding, -7);
  const std::size_t count = sites.size();
  std::vector<double> lift(count, 0.0), first_lift(count, 0.0);
  std::vector<double> room(count);  // first lift, or clearance of what stays
  path->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceSite& site = sites[i];
    (*path)[i] = site.point;
    if (site.direction.isZero()) {
      room[i] = segments.Distance(site.point, site.point, clearance);
      continue;
    }
    room[i] = RoomAbove(site, segments, clearance, rounding);
    lift[i] = first_lift[i] = room[i];
    (*path)[i] += lift[i] * site.direction;
  }
  // What is left of the rooms of two ends when they have been lowered.
  const auto height = [&](std::size_t i) {
    return lift[i] > 0.0 ? lift[i] : room[i];
  };
  const auto grazes = [&](std::size_t k) {
    const double low = std::min(height(k), height(k + 1));
    return std::max(lift[k], lift[k + 1]) >
               0.125 * std::min(room[k], room[k + 1]) &&
           segments.ComesWithin((*path)[k], (*path)[k + 1], 0.5 * low);
  };
  std::size_t k = 0;
  while (k + 1 < count) {
    ++counts->tests;
    if (!segments.Meets((*path)[k], (*path)[k + 1]) && !grazes(k)) {
      ++counts->lifted;
      ++k;
      continue;
    }
    const std::size_t larger = lift[k] > lift[k + 1] ? k : k + 1;
    if (!(lift[larger] > least)) {
      return SegmentsToBlame(sites, first_lift, least, segments);
    }
    lift[larger] *= 0.5;
    ++counts->halvings;
    (*path)[larger] =
        sites[larger].point + lift[larger] * sites[larger].direction;
    // The segment before has changed too.
    if (larger == k && k > 0) --k;
  }
  return {};
}

}  // namespace phongpd
