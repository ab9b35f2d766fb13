// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/lattice.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

constexpr int kFives = 22;  // the largest power of five that is a double

// 2^m · 5^k, the finest of which numbers below 2^exponent are fewer than
// 2^kLatticeBits.
LatticeUnit UnitOfFives(int k, int exponent) {
  double power = 1.0;
  for (int i = 0; i < std::abs(k); ++i) power *= 5.0;
  int bits = 0;
  std::frexp(power, &bits);
  LatticeUnit unit;
  unit.divides = k < 0;
  unit.scale = std::ldexp(
      power, unit.divides ? kLatticeBits - bits : 1 - kLatticeBits - bits);
  unit.exponent = exponent;
  return unit;
}

bool IsOnLattice(double coordinate, const LatticeUnit& unit) {
  return unit.Length(std::nearbyint(unit.Count(coordinate))) == coordinate;
}

}  // namespace

double LatticeUnit::Length(double n) const {
  return std::ldexp(divides ? n / scale : n * scale, exponent);
}

double LatticeUnit::Count(double length) const {
  const double scaled = std::ldexp(length, -exponent);
  return divides ? scaled * scale : scaled / scale;
}

std::optional<LatticeUnit> FindExactUnit(
    const std::vector<double>& coordinates) {
  double largest = 0.0;
  for (const double x : coordinates) largest = std::max(largest, std::abs(x));
  int exponent = 0;
  std::frexp(largest, &exponent);
  for (int k = 0; k <= kFives; ++k) {
    for (const int signed_k : {-k, k}) {
      const LatticeUnit unit = UnitOfFives(signed_k, exponent);
      if (std::all_of(coordinates.begin(), coordinates.end(),
                      [&unit](double x) { return IsOnLattice(x, unit); })) {
        return unit;
      }
    }
  }
  return std::nullopt;
}

std::optional<double> FindCommonUnit(std::vector<double> lengths,
                                     double noise) {
  double longest = 0.0;
  for (const double length : lengths) longest = std::max(longest, length);
  if (longest == 0.0) return std::nullopt;
  const double least = std::max(0x1p-17 * longest, 0x1p10 * noise);
  // What a remainder may be for nothing but the noise of its terms, which
  // Euclid's algorithm multiplies by the numbers it cancels.
  const double nothing = 0x1p-3 * least;
  double unit = 0.0;
  for (const double length : lengths) {
    double rest = unit > 0.0 ? std::abs(std::remainder(length, unit)) : length;
    while (rest > nothing) {
      const double next =
          unit > 0.0 ? std::abs(std::remainder(unit, rest)) : 0.0;
      unit = rest;
      rest = next;
      if (unit < least) return std::nullopt;
    }
  }
  // The longest length tells it best; what shorter ones told says how many
  // units it is.
  std::sort(lengths.begin(), lengths.end());
  for (const double length : lengths) {
    const double n = std::nearbyint(length / unit);
    if (n >= 1.0) unit = length / n;
  }
  const bool fits =
      std::all_of(lengths.begin(), lengths.end(), [&](double length) {
        return std::abs(std::remainder(length, unit)) <= 2 * noise;
      });
  return fits ? std::optional<double>(unit) : std::nullopt;
}

}  // namespace phongpd::internal
