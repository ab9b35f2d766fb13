// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>

namespace phongpd::internal {

// The checks that every procedural shape makes of its parameters.  Each throws
// InputError "SHAPE: PARAMETER must be EXPECTED, found VALUE".

// A length that is positive, finite and far from overflow when cubed.
void RequireLength(const char* shape, const char* parameter, double value);

// A length strictly between 0 and `limit`.
void RequireLengthBelow(const char* shape, const char* parameter, double value,
                        double limit, const char* limit_name);

// A count in [minimum, maximum]; the default keeps every index within an int,
// also for a grid of two such counts.
void RequireCount(const char* shape, const char* parameter, int value,
                  int minimum, int maximum = 10'000);

// No shape has more triangles: ten times the largest operand measured.
inline constexpr int kMaxTriangles = 10'000'000;

// A number of triangles, 2·first·second of two counts that RequireCount let
// pass; `formula` says of which.
void RequireTriangles(const char* shape, const char* formula, int first,
                      int second);

// The point at i/n of a full turn on the unit circle: multiples of a quarter
// turn are exact, and n divisible by 4 gives an exact quarter-turn symmetry.
Eigen::Vector2d UnitCircle(int i, int n);

// [0, 1) from the engine's bits: the standard's distributions may differ from
// library to library.
double UnitRandom(std::mt19937_64* random);

}  // namespace phongpd::internal
