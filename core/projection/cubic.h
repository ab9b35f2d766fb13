// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace phongpd {

// c₀ + c₁ s + c₂ s² + c₃ s³
using Cubic = std::array<double, 4>;

// Real roots in ascending order; multiple roots may be given once.
struct CubicRoots {
  int count = 0;
  std::array<double, 3> root{};

  const double* begin() const { return root.data(); }
  const double* end() const { return root.data() + count; }
};

// All roots in the closed interval [low, high], found between the critical
// points, where the cubic is monotone: safeguarded Newton in brackets, so no
// root is lost to a vanishing leading coefficient and nothing can diverge.  A
// critical point whose value is zero within rounding counts as a double root
// (a fold).  Simple roots are accurate to a few ulp of the coefficients'
// rounding, k-fold roots to its k-th root.  No roots for the zero polynomial
// or non-finite input.  The values c_i·s^i on the interval must not overflow.
CubicRoots SolveCubic(const Cubic& c, double low, double high) noexcept;

// All real roots, whatever the scale of coefficients and roots, as long as
// the magnitudes of the non-zero roots span less than 1e100.
CubicRoots SolveCubic(const Cubic& c) noexcept;

}  // namespace phongpd
