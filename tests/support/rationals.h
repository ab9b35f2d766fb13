// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cstdint>
#include <utility>

#include "core/minkowski/operands/exact_points.h"

// The engine's points in unbounded rationals, by textbook formulas: the other
// route of tests of its fixed-width predicates.
namespace phongpd::testing {

// Of GMP, no expression templates: gcc 12 warns of boost's own rationals.
using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational,
                                  boost::multiprecision::et_off>;
using RationalPoint = std::array<Rational, 3>;

inline Rational ToRational(internal::Int128 value) {
  const bool negative = value < 0;
  Rational high(static_cast<std::int64_t>((negative ? -value : value) >> 62));
  const Rational low(static_cast<std::int64_t>(
      (negative ? -value : value) & ((internal::Int128{1} << 62) - 1)));
  high = high * Rational(std::int64_t{1} << 62) + low;
  return negative ? Rational(-high) : high;
}

inline Rational ToRational(const internal::Wide& value) {
  return Rational(boost::multiprecision::mpz_int(value.str()));
}

inline RationalPoint ToRational(const internal::GridPoint& p) {
  return {Rational(p[0]), Rational(p[1]), Rational(p[2])};
}

// normal·p − offset.
inline Rational Height(const internal::GridPlane& plane,
                       const RationalPoint& p) {
  Rational sum = -ToRational(plane.offset);
  for (std::size_t k = 0; k < 3; ++k) sum += ToRational(plane.normal[k]) * p[k];
  return sum;
}

// Where three planes meet, by elimination; they do in one point.
inline RationalPoint Solve(const std::array<internal::GridPlane, 3>& planes) {
  std::array<std::array<Rational, 4>, 3> row;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      row[i][k] = ToRational(planes[i].normal[k]);
    }
    row[i][3] = ToRational(planes[i].offset);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    std::size_t pivot = k;
    while (row[pivot][k] == 0) ++pivot;
    std::swap(row[k], row[pivot]);
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == k) continue;
      const Rational factor = row[i][k] / row[k][k];
      for (std::size_t j = k; j < 4; ++j) row[i][j] -= factor * row[k][j];
    }
  }
  return {row[0][3] / row[0][0], row[1][3] / row[1][1], row[2][3] / row[2][2]};
}

inline RationalPoint ToRational(const internal::PointDefinition& d) {
  switch (d.kind) {
    case internal::PointDefinition::kVertex:
      return ToRational(d.a);
    case internal::PointDefinition::kEdge: {
      RationalPoint p = ToRational(d.a);
      const RationalPoint b = ToRational(d.b);
      const Rational t =
          ToRational(d.side_a) / (ToRational(d.side_a) - ToRational(d.side_b));
      for (std::size_t k = 0; k < 3; ++k) p[k] += t * (b[k] - p[k]);
      return p;
    }
    default:
      return Solve(d.planes);
  }
}

}  // namespace phongpd::testing
