// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "constraints/free_space.h"
#include "planners/retraction/contact_model.h"

namespace phongpd {

// All that a planner needs which asks for nothing but validity and motion
// checks: free space, at whatever level it was modelled, and the box in which
// samples are drawn.
struct MotionDomain {
  std::shared_ptr<const FreeSpace> free_space;
  BoundingBox region;  // not empty

  double diagonal() const { return region.Diagonal(); }
  // As ContactModel::floor().
  double floor() const { return 1e-9 * diagonal(); }
};

// That of a model, which it keeps alive; without free space for null.
MotionDomain DomainOf(const std::shared_ptr<const ContactModel>& model);

// Where samples for a path from start to goal are worth drawing, when nothing
// is known of the cells of free space: the bounds, or the box around start,
// goal and all obstacles of `convolutions`, with room on every side.  Start and
// goal are joined within it if they are joined at all.
BoundingBox SamplingRegion(const FreeSpace& convolutions,
                           const Eigen::Vector3d& start,
                           const Eigen::Vector3d& goal);

}  // namespace phongpd
