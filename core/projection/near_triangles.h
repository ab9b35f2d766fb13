// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/projection/surface_walk.h"

namespace phongpd {

// The closest point of a surface for an x that moves in small steps: exact,
// from the triangles that were near some steps ago.  All with distance ≤ r
// from an anchor a are listed with that distance, so at x nothing that is
// closer than r − |x − a| is missing, and what is listed at ρ is no closer than
// ρ − |x − a|.  Allocates once.
class NearTriangles {
 public:
  // As SurfaceWalk::FindClosest on all components, `seed` valid; `step` ≥ 0 is
  // how far x moves from one call to the next.  Which of several closest points
  // it gives depends on the calls before.
  SurfaceFoot FindClosest(const SurfaceWalk& walk, const Eigen::Vector3d& x,
                          const SurfaceFoot& seed, double step);

 private:
  // A triangle at `far` from the anchor, in the plane normal·y = offset; normal
  // zero where rounding leaves it no plane worth the name.
  struct Near {
    double far, offset;
    int triangle;
    Eigen::Vector3d normal;
  };

  void List(const SurfaceWalk& walk, const Eigen::Vector3d& x, double radius);

  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();
  double radius_ = -1.0;  // r; none is listed
  double ahead_ = 8.0;    // steps that the next list is to be good for
  std::vector<Near> near_;
};

}  // namespace phongpd
