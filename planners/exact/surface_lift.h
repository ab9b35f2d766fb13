// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <list>
#include <vector>

#include "core/mesh/segment_tree.h"
#include "planners/exact/free_space.h"
#include "planners/exact/start_repair.h"
#include "planners/exact/surface_geodesic.h"

namespace phongpd::internal {

// Lifts a polyline on a contact surface into free space: point s becomes
// s + h·u for a unit direction u and a height h > 0.
class SurfaceLift {
 public:
  struct Point {
    Eigen::Vector3d foot;
    Eigen::Vector3d direction;  // u
    double height = 0.0;        // h
    int triangle = -1;          // holds this foot and the next one

    Eigen::Vector3d Position() const { return foot + height * direction; }
  };

  // All outlive the lift.  Lengths in the user's unit.
  SurfaceLift(const FreeSpace& space, const SegmentTree& segments,
              const std::vector<Eigen::Vector3d>& facet_normals,
              double diagonal, double margin)
      : space_(space),
        segments_(segments),
        facet_normals_(facet_normals),
        tiny_(1e-12 * diagonal),
        lowest_(1e-10 * diagonal),
        margin_(margin) {}

  // before → geodesic → after as an exactly free polyline; before and after
  // are given as lifted points whose feet are the ends of the geodesic.  Empty
  // if it cannot be lifted.
  std::vector<Eigen::Vector3d> Lift(const Point& before,
                                    const Geodesic& geodesic,
                                    const Point& after,
                                    LiftCounters* counters) const;

 private:
  // h = min(limit, half the gap along u), then up the distance gradient.
  // False if no free point was found above the foot.
  bool Raise(double limit, Point* point) const;
  // Is the ray from the foot to x free beyond the triangles at the foot?
  bool Sees(const Eigen::Vector3d& foot, const Eigen::Vector3d& x) const;

  const FreeSpace& space_;
  const SegmentTree& segments_;
  const std::vector<Eigen::Vector3d>& facet_normals_;
  double tiny_, lowest_, margin_;
};

}  // namespace phongpd::internal
