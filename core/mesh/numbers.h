// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>

// What sources of every folder need of numbers, named once: several of them may
// be compiled as one.
namespace phongpd::internal {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Of a number of a vertex, triangle or corner, which are ints.
inline std::size_t At(int k) { return static_cast<std::size_t>(k); }

// −1, 0 or 1.
inline int Sign(double x) { return (x > 0.0) - (x < 0.0); }

}  // namespace phongpd::internal
