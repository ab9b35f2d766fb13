// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/exact_sign.h"

#include <CGAL/Gmpq.h>

namespace phongpd::internal {

namespace {
// Rationals rather than CGAL's kernel predicates: those stop the process with
// SIGFPE on denormal input.
using Rational = CGAL::Gmpq;

int SignOf(const Rational& x) { return static_cast<int>(CGAL::sign(x)); }
}  // namespace

int Orient2dExact(double ax, double ay, double bx, double by, double cx,
                  double cy) {
  const Rational x(ax), y(ay);
  return SignOf((Rational(bx) - x) * (Rational(cy) - y) -
                (Rational(by) - y) * (Rational(cx) - x));
}

int Orient3dExact(const double* a, const double* b, const double* c,
                  const double* d) {
  Rational u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i) {
    const Rational origin(a[i]);
    u[i] = Rational(b[i]) - origin;
    v[i] = Rational(c[i]) - origin;
    w[i] = Rational(d[i]) - origin;
  }
  return SignOf(w[0] * (u[1] * v[2] - u[2] * v[1]) +
                w[1] * (u[2] * v[0] - u[0] * v[2]) +
                w[2] * (u[0] * v[1] - u[1] * v[0]));
}

}  // namespace phongpd::internal
