// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

// Exact integer geometry on the grid all contact-space work happens on.
//
// Operand coordinates are integers below 2^38 in magnitude, so sums b − a stay
// below 2^39 and differences of sums below 2^40; both are exact in double.  A
// facet normal (cross product of two edge vectors of one operand, or of one
// edge of each) stays below 2^80, and normal · difference below 2^122: every
// predicate on convolution vertices fits 128 bits.
namespace phongpd::internal {

inline constexpr int kGridBits = 38;

__extension__ using Int128 = __int128;

using GridPoint = std::array<std::int64_t, 3>;
using GridNormal = std::array<Int128, 3>;

inline GridPoint operator-(const GridPoint& a, const GridPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline GridPoint operator+(const GridPoint& a, const GridPoint& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline GridNormal Cross(const GridPoint& a, const GridPoint& b) {
  return {Int128(a[1]) * b[2] - Int128(a[2]) * b[1],
          Int128(a[2]) * b[0] - Int128(a[0]) * b[2],
          Int128(a[0]) * b[1] - Int128(a[1]) * b[0]};
}
inline Int128 Dot(const GridNormal& n, const GridPoint& d) {
  return n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
}
inline GridNormal Negated(const GridNormal& n) { return {-n[0], -n[1], -n[2]}; }
inline bool IsZero(const GridNormal& n) { return !n[0] && !n[1] && !n[2]; }

template <typename T>
int Sign(const T& value) {
  return (value > 0) - (value < 0);
}

// Exact for points, rounded for normals.
inline Eigen::Vector3d ToDouble(const GridPoint& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]),
          static_cast<double>(p[2])};
}
inline Eigen::Vector3d ToDouble(const GridNormal& n) {
  return {static_cast<double>(n[0]), static_cast<double>(n[1]),
          static_cast<double>(n[2])};
}

// A position to the nearest 2^-12 of a grid step: its sum with a grid point has
// 2^40 and 12 fractional bits at the most, which a double holds.  Farther out
// nothing is, and doubles are as coarse by themselves.
inline Eigen::Vector3d RoundedToFractions(const Eigen::Vector3d& q) {
  Eigen::Vector3d x = q;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(x[k]) < 0x1p40) x[k] = std::round(x[k] * 0x1p12) * 0x1p-12;
  }
  return x;
}

// Index of the component of largest magnitude.
template <typename Vector>
int LargestAxis(const Vector& v) {
  const auto magnitude = [&v](int k) { return v[k] < 0 ? -v[k] : v[k]; };
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (magnitude(k) > magnitude(axis)) axis = k;
  }
  return axis;
}

struct GridPointHash {
  std::size_t operator()(const GridPoint& p) const {
    std::uint64_t h = 0;
    for (const std::int64_t x : p) {
      h = (h ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ULL;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }
};

}  // namespace phongpd::internal
