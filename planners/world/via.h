// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "planners/world/length.h"

namespace phongpd {

// A place that a motion in time passes on its way.
struct Via {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Length tolerance = Length::FromShare(0.001);  // passed as close, in (0, D]
  double dwell = 0.0;  // seconds to rest there, at the point itself
};

}  // namespace phongpd
