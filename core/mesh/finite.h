// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace phongpd {

// Are all coordinates numbers, neither NaN nor infinite?  Quiet, as
// std::isfinite is; Eigen's allFinite subtracts infinity from itself, an
// invalid operation (scripts/check.sh fptrap).
inline bool IsFinite(const Eigen::Vector3d& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

}  // namespace phongpd
