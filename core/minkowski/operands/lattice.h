// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

// Which coordinates are multiples of one unit, so that they are integers and
// need no rounding.
namespace phongpd::internal {

// u = scale · 2^exponent, or 2^exponent / scale.
struct LatticeUnit {
  double scale = 1.0;
  bool divides = false;
  int exponent = 0;

  // The double nearest to n·u where n is a double and scale is exact: i / 10
  // rather than i · 0.1.
  double Length(double n) const;
  // length / u, rounded.
  double Count(double length) const;
};

// Multiples n·u of an exact unit have |n| below this: 2^11 doubles lie between
// two neighbours even where n is largest, so that no number is on the lattice
// by accident.
inline constexpr int kLatticeBits = 42;

// The unit 2^m · 5^k, |k| ≤ 22, of the least |k|, such that every coordinate
// is the double nearest to a multiple of it: binary fractions, and what people
// and text files write in decimals.  Powers of two as a factor change nothing
// but m.  Requires finite coordinates, not all of them zero.
std::optional<LatticeUnit> FindExactUnit(
    const std::vector<double>& coordinates);

// The unit of which all `lengths` ≥ 0 are multiples up to 2·noise: Euclid's
// algorithm on rounded numbers.  Finds units down to 2^-17 of the longest
// length, as far as the noise lets it; none finer than 2^10 · noise.
std::optional<double> FindCommonUnit(std::vector<double> lengths, double noise);

}  // namespace phongpd::internal
