// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <phongpd/core/contact/contact_space.h>

// The problem that every planner of this folder solves: a cube of side 1 goes
// around a box of side 2.
inline phongpd::TriangleMesh Box(double half) {
  phongpd::TriangleMesh box;
  for (int corner = 0; corner < 8; ++corner) {
    box.vertices.emplace_back((corner & 1) != 0 ? half : -half,
                              (corner & 2) != 0 ? half : -half,
                              (corner & 4) != 0 ? half : -half);
  }
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                   {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                   {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

inline phongpd::ContactSpace BoxSpace() {
  return phongpd::BuildContactSpace(Box(0.5), Box(1.0));
}

inline const Eigen::Vector3d kStart(-3.0, 0.1, 0.2), kGoal(3.0, 0.3, -0.1);
// C_obj is the box of side 3.  The shortest way is over its face y = 1.5,
// √(1.5² + 1.4²) + 3 + √(1.5² + 1.2²) = 6.97 even where it may change z for
// nothing.
inline constexpr double kShortest = 6.9;
