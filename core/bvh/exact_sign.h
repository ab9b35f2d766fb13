// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>

// Signs of determinants of finite doubles, exact for every finite input
// (denormals and scales 1e±300 included), in three stages: a floating-point
// filter, inline; floating-point expansions where it cannot decide; rational
// numbers where even those could under- or overflow (a coordinate that is not
// 0 and not between 1e-70 and 1e70) – only these allocate.  Filter bounds and
// expansions: Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast
// Robust Geometric Predicates, 1997.  The filter holds without underflow only,
// so a determinant below kFilterFloor is passed on as well; overflow makes the
// comparisons false and is passed on too.
namespace phongpd {

namespace internal {
constexpr double kFilterFloor = 1e-250;
int Orient2dExact(double ax, double ay, double bx, double by, double cx,
                  double cy);
int Orient3dExact(const double* a, const double* b, const double* c,
                  const double* d);
}  // namespace internal

// Sign of (b − a) × (c − a) in the plane: +1 when a, b, c turn left.
inline int Orient2d(double ax, double ay, double bx, double by, double cx,
                    double cy) {
  const double left = (bx - ax) * (cy - ay);
  const double right = (by - ay) * (cx - ax);
  const double det = left - right;
  const double bound =
      4e-16 * (std::abs(left) + std::abs(right)) + internal::kFilterFloor;
  if (det > bound) return 1;
  if (-det > bound) return -1;
  return internal::Orient2dExact(ax, ay, bx, by, cx, cy);
}

// Sign of ((b − a) × (c − a)) · (d − a): +1 when d lies on the side of the
// triangle's normal.
inline int Orient3d(const double* a, const double* b, const double* c,
                    const double* d) {
  const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
  const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
  const double dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
  const double bycz = by * cz, bzcy = bz * cy;
  const double bzcx = bz * cx, bxcz = bx * cz;
  const double bxcy = bx * cy, bycx = by * cx;
  const double det =
      dx * (bycz - bzcy) + dy * (bzcx - bxcz) + dz * (bxcy - bycx);
  const double permanent = std::abs(dx) * (std::abs(bycz) + std::abs(bzcy)) +
                           std::abs(dy) * (std::abs(bzcx) + std::abs(bxcz)) +
                           std::abs(dz) * (std::abs(bxcy) + std::abs(bycx));
  const double bound = 1e-15 * permanent + internal::kFilterFloor;
  if (det > bound) return 1;
  if (-det > bound) return -1;
  return internal::Orient3dExact(a, b, c, d);
}

}  // namespace phongpd
