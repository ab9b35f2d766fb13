// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>

namespace phongpd {

// A vector of three draws, z drawn first, then y, then x.  One draw a
// statement: in which order a call's arguments are evaluated is the compiler's
// choice, and the same seed must give the same scene by each of them.
template <typename Distribution>
Eigen::Vector3d RandomVector(Distribution* distribution,
                             std::mt19937_64* random) {
  const double z = (*distribution)(*random);
  const double y = (*distribution)(*random);
  const double x = (*distribution)(*random);
  return {x, y, z};
}

}  // namespace phongpd
