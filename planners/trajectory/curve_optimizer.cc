// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_optimizer.h"

#include "planners/trajectory/curve_rests.h"
#include "planners/trajectory/curve_search.h"

namespace phongpd {

CurveSummary OptimizeCurve(const FreeSpace& space, double diagonal,
                           const std::vector<Eigen::Vector3d>& free_path,
                           const CurveOptions& options) {
  internal::RequireCurve(diagonal, free_path, options);
  if (internal::HasRests(options)) {
    return internal::OptimizeWithRests(space, diagonal, free_path, options);
  }
  internal::CurveSearch search(space, diagonal, options);
  search.Begin(free_path);
  search.Refine();
  return search.Summary();
}

}  // namespace phongpd
