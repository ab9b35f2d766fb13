// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Gmpq.h>

#include <array>
#include <vector>

// Polynomials of degree 3 and less with rational coefficients, and their signs
// at each other's roots.  Only for sources: CGAL.
namespace phongpd::internal {

using Rational = CGAL::Gmpq;

// c₀ + c₁ t + c₂ t² + c₃ t³.
struct RationalCubic {
  std::array<Rational, 4> c;

  int Degree() const;  // −1 of 0
  bool IsZero() const { return Degree() < 0; }
  Rational At(const Rational& t) const;
  int SignAt(const Rational& t) const;
};

RationalCubic operator+(const RationalCubic& p, const RationalCubic& q);
RationalCubic operator-(const RationalCubic& p, const RationalCubic& q);
// Of degree 3 or less.
RationalCubic operator*(const RationalCubic& p, const RationalCubic& q);
RationalCubic operator*(const Rational& factor, const RationalCubic& p);

// Not 0 and of one sign on [a, b], as its Bernstein coefficients show; false
// where they do not.
bool HasOneSign(const RationalCubic& p, const Rational& a, const Rational& b,
                int* sign);

// A root, alone in [low, high] of the roots of `poly`, which has no double one
// there; low = high where it is rational and was hit.
struct CubicRoot {
  RationalCubic poly;
  Rational low, high;

  // Halves the interval.
  void Refine();
  bool IsExact() const { return low == high; }
};

// All in [a, b], p not 0.
std::vector<CubicRoot> RootsIn(const RationalCubic& p, const Rational& a,
                               const Rational& b);

// The sign of q at the root, which is refined for it.
int SignAtRoot(const RationalCubic& q, CubicRoot* root);

}  // namespace phongpd::internal
