// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/path_lift.h"

#include <cmath>

namespace phongpd {

using Eigen::Vector3d;

int LiftRoute(const std::vector<SurfaceSite>& sites,
              const SegmentTree& segments, double clearance, double rounding,
              std::vector<Vector3d>* path, LiftCounts* counts) {
  // Below an ulp of the coordinates nothing moves any more.
  const double least = std::ldexp(rounding, -7);
  std::vector<double> lift(sites.size(), 0.0);
  path->resize(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const SurfaceSite& site = sites[i];
    (*path)[i] = site.point;
    if (site.direction.isZero()) continue;
    // Half the gap is less than the clearance only if something is nearer
    // than twice the clearance.
    const SegmentTree::Hit hit = segments.FirstHitBeyond(
        site.point, site.point + 2.0 * clearance * site.direction, rounding);
    lift[i] = hit.fraction * clearance;
    (*path)[i] += lift[i] * site.direction;
  }
  std::size_t k = 0;
  while (k + 1 < sites.size()) {
    ++counts->tests;
    if (!segments.Meets((*path)[k], (*path)[k + 1])) {
      ++counts->lifted;
      ++k;
      continue;
    }
    const std::size_t larger = lift[k] > lift[k + 1] ? k : k + 1;
    if (!(lift[larger] > least)) return static_cast<int>(k);
    lift[larger] *= 0.5;
    ++counts->halvings;
    (*path)[larger] =
        sites[larger].point + lift[larger] * sites[larger].direction;
    // The segment before has changed too.
    if (larger == k && k > 0) --k;
  }
  return -1;
}

}  // namespace phongpd
