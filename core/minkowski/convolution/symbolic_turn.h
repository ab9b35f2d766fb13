// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/minkowski/operands/exact_grid.h"

namespace phongpd::internal {

// Ties between features of P and Q are decided as if Q had been turned by an
// angle δ → 0⁺ about the axis ω = (1, M, M²), M = 2^122.
//
// A tie is n·d = 0 for the normal n ≠ 0 of a facet of one operand and an edge
// vector d ≠ 0 of the other, and the turn decides it to first order, always:
//   n·(d + δ ω×d + O(δ²)) = δ ω·(d × n) + O(δ²),
// and d × n ≠ 0 because |d × n| = |d||n|.  Its components are below 2^121 =
// M/2, so the sign of ω·(d × n) is that of the last one that is not zero.

// Sign of n·d after the turn when d belongs to Q, which is +1 or −1; its
// opposite when n does.  Requires n·d = 0, n ≠ 0, d ≠ 0, |n| < 2^80,
// |d| < 2^40.
inline int TurnedSign(const GridNormal& n, const GridPoint& d) {
  for (int k = 2; k > 0; --k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Int128 component = d[i] * n[j] - d[j] * n[i];
    if (component != 0) return Sign(component);
  }
  return Sign(d[1] * n[2] - d[2] * n[1]);
}

}  // namespace phongpd::internal
