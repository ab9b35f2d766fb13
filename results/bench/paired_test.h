// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace phongpd::bench {

// Exact two-sided sign test: how likely is it that of wins + losses fair coins
// the fewer are at most as many as here?  1 without any.
double SignTest(int wins, int losses);

// Holm's step-down: the p values as they are after as many tests, in the order
// given.  A family of tests then errs at all with at most the level taken.
std::vector<double> Holm(const std::vector<double>& p);

}  // namespace phongpd::bench
