// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/exact_sign.h"

#include <CGAL/Gmpq.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace phongpd::internal {
namespace {

using Rational = CGAL::Gmpq;
using Point = std::array<double, 3>;

int SignByRationals(const Point& a, const Point& b, const Point& c,
                    const Point& d) {
  Rational u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i) {
    u[i] = Rational(b[i]) - Rational(a[i]);
    v[i] = Rational(c[i]) - Rational(a[i]);
    w[i] = Rational(d[i]) - Rational(a[i]);
  }
  return static_cast<int>(CGAL::sign(w[0] * (u[1] * v[2] - u[2] * v[1]) +
                                     w[1] * (u[2] * v[0] - u[0] * v[2]) +
                                     w[2] * (u[0] * v[1] - u[1] * v[0])));
}

int SignByRationals(const Point& a, const Point& b, const Point& c) {
  const Rational x(a[0]), y(a[1]);
  return static_cast<int>(
      CGAL::sign((Rational(b[0]) - x) * (Rational(c[1]) - y) -
                 (Rational(b[1]) - y) * (Rational(c[0]) - x)));
}

// Coordinates of 2^-1074 to 2^1023, many of them equal or of equal size, so
// that every third determinant or so vanishes.
class Extremes {
 public:
  Point Next() {
    Point p;
    for (double& x : p) x = Coordinate();
    return p;
  }

 private:
  double Coordinate() {
    static constexpr std::array<int, 7> kExponents = {-1074, -1040, -1022, -300,
                                                      0,     300,   1023};
    const double mantissa = std::array<double, 4>{
        0.0, 1.0, 1.0 + std::numeric_limits<double>::epsilon(),
        1.5}[random_() % 4];
    const double size = std::ldexp(mantissa, kExponents[random_() % 7]);
    return random_() % 2 == 0 ? size : -size;
  }

  std::mt19937 random_{7};
};

TEST(Orient3dExact, IsThatOfRationalsFromTheLeastToTheLargestDoubles) {
  Extremes extremes;
  std::array<int, 3> count = {};
  for (int i = 0; i < 20000; ++i) {
    const Point a = extremes.Next(), b = extremes.Next(), c = extremes.Next();
    const Point d = i % 3 == 0 ? a : extremes.Next();
    const int expected = SignByRationals(a, b, c, d);
    ASSERT_EQ(Orient3dExact(a.data(), b.data(), c.data(), d.data()), expected)
        << i;
    ++count[static_cast<std::size_t>(expected + 1)];
  }
  for (const int n : count) EXPECT_GT(n, 2000);
}

TEST(Orient2dExact, IsThatOfRationalsFromTheLeastToTheLargestDoubles) {
  Extremes extremes;
  std::array<int, 3> count = {};
  for (int i = 0; i < 20000; ++i) {
    const Point a = extremes.Next(), b = extremes.Next();
    const Point c = i % 3 == 0 ? b : extremes.Next();
    const int expected = SignByRationals(a, b, c);
    ASSERT_EQ(Orient2dExact(a[0], a[1], b[0], b[1], c[0], c[1]), expected) << i;
    ++count[static_cast<std::size_t>(expected + 1)];
  }
  for (const int n : count) EXPECT_GT(n, 2000);
}

// Denormal coordinates have fewer bits than others, and none may be lost.
TEST(Orient3dExact, SeesTheLeastDouble) {
  const double least = std::numeric_limits<double>::denorm_min();
  const Point a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0};
  for (const double z : {least, 3 * least, 1e-310}) {
    const Point above = {0, 0, z}, below = {0, 0, -z};
    EXPECT_EQ(Orient3dExact(a.data(), b.data(), c.data(), above.data()), 1);
    EXPECT_EQ(Orient3dExact(a.data(), b.data(), c.data(), below.data()), -1);
  }
}

}  // namespace
}  // namespace phongpd::internal
