// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "constraints/free_space.h"
#include "planners/retraction/contact_model.h"

namespace phongpd {

// What a planner needs that only tests states and motions: free space, modelled
// in one way or another, and the region in which samples are drawn.
struct MotionDomain {
  std::shared_ptr<const FreeSpace> free_space;
  BoundingBox region;  // not empty

  double diagonal() const { return region.Diagonal(); }
  // 1e-9 · diagonal(), like ContactModel::floor().
  double floor() const { return 1e-9 * diagonal(); }
};

// The domain of a model, which it keeps alive; without free space for null.
MotionDomain DomainOf(const std::shared_ptr<const ContactModel>& model);

// The region in which to draw samples for a path from start to goal if the
// cells of free space are not known: the bounds, or the box of start, goal and
// all obstacles of `convolutions`, with room on every side.  If a path exists,
// one exists within it.
BoundingBox SamplingRegion(const FreeSpace& convolutions,
                           const Eigen::Vector3d& start,
                           const Eigen::Vector3d& goal);

}  // namespace phongpd
