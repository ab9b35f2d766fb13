// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/exact_sign.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

namespace phongpd::internal {

namespace {

// a + b = sum + error exactly.
void TwoSum(double a, double b, double* sum, double* error) {
  *sum = a + b;
  const double b_part = *sum - a;
  *error = (a - (*sum - b_part)) + (b - b_part);
}

// a·b = product + error exactly (Dekker, Veltkamp).
void TwoProduct(double a, double b, double* product, double* error) {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double a_big = kSplitter * a, b_big = kSplitter * b;
  const double a_high = a_big - (a_big - a), b_high = b_big - (b_big - b);
  const double a_low = a - a_high, b_low = b - b_high;
  *product = a * b;
  *error = a_low * b_low -
           (((*product - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

// An exact sum of doubles: non-overlapping terms in increasing magnitude,
// zeros left out.  N bounds the number of doubles added.
template <int N>
class Expansion {
 public:
  void Add(double value) {
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      double sum, error;
      TwoSum(value, term_[i], &sum, &error);
      if (error != 0.0) term_[kept++] = error;
      value = sum;
    }
    if (value != 0.0) term_[kept++] = value;
    size_ = kept;
  }
  void AddProduct(double a, double b) {
    double product, error;
    TwoProduct(a, b, &product, &error);
    Add(error);
    Add(product);
  }
  int Sign() const { return size_ == 0 ? 0 : term_[size_ - 1] > 0.0 ? 1 : -1; }
  int size() const { return size_; }
  double operator[](int i) const { return term_[i]; }

 private:
  double term_[N];
  int size_ = 0;
};

// a − b exactly.
struct ExactDifference {
  double part[2];
  ExactDifference(double a, double b) { TwoSum(a, -b, &part[1], &part[0]); }
};

// u·v − w·z.
Expansion<16> Minor(const ExactDifference& u, const ExactDifference& v,
                    const ExactDifference& w, const ExactDifference& z) {
  Expansion<16> minor;
  for (const double a : u.part) {
    for (const double b : v.part) minor.AddProduct(a, b);
  }
  for (const double a : w.part) {
    for (const double b : z.part) minor.AddProduct(-a, b);
  }
  return minor;
}

// Neither products of three nor their rounding errors leave the range.
bool IsModerate(double x) {
  const double size = std::abs(x);
  return size == 0.0 || (size >= 1e-70 && size <= 1e70);
}

// Integers rather than CGAL's kernel predicates: those stop the process with
// SIGFPE on denormal input.  Of headers alone, so that queries also run where
// there is no CGAL (the viewer's probe).
using Integer = boost::multiprecision::cpp_int;

// x·2^1074, which is an integer for every finite double.
Integer Scaled(double x) {
  int exponent;
  const double mantissa = std::frexp(x, &exponent);
  Integer integer(static_cast<std::int64_t>(std::ldexp(mantissa, 53)));
  const int shift = exponent - 53 + 1074;
  // What a denormal number lacks in bits are zeros of its mantissa.
  if (shift < 0) {
    integer >>= static_cast<unsigned>(-shift);
  } else {
    integer <<= static_cast<unsigned>(shift);
  }
  return integer;
}

}  // namespace

int Orient2dExact(double ax, double ay, double bx, double by, double cx,
                  double cy) {
  if (IsModerate(ax) && IsModerate(ay) && IsModerate(bx) && IsModerate(by) &&
      IsModerate(cx) && IsModerate(cy)) {
    return Minor({bx, ax}, {cy, ay}, {by, ay}, {cx, ax}).Sign();
  }
  const Integer x = Scaled(ax), y = Scaled(ay);
  const Integer det =
      (Scaled(bx) - x) * (Scaled(cy) - y) - (Scaled(by) - y) * (Scaled(cx) - x);
  return det.sign();
}

int Orient3dExact(const double* a, const double* b, const double* c,
                  const double* d) {
  bool moderate = true;
  for (int i = 0; i < 3; ++i) {
    moderate = moderate && IsModerate(a[i]) && IsModerate(b[i]) &&
               IsModerate(c[i]) && IsModerate(d[i]);
  }
  if (moderate) {
    Expansion<192> det;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Expansion<16> minor =
          Minor({b[j], a[j]}, {c[k], a[k]}, {b[k], a[k]}, {c[j], a[j]});
      const ExactDifference w(d[i], a[i]);
      for (int m = 0; m < minor.size(); ++m) {
        det.AddProduct(minor[m], w.part[0]);
        det.AddProduct(minor[m], w.part[1]);
      }
    }
    return det.Sign();
  }
  Integer u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i) {
    const Integer origin = Scaled(a[i]);
    u[i] = Scaled(b[i]) - origin;
    v[i] = Scaled(c[i]) - origin;
    w[i] = Scaled(d[i]) - origin;
  }
  const Integer det = w[0] * (u[1] * v[2] - u[2] * v[1]) +
                      w[1] * (u[2] * v[0] - u[0] * v[2]) +
                      w[2] * (u[0] * v[1] - u[1] * v[0]);
  return det.sign();
}

}  // namespace phongpd::internal
