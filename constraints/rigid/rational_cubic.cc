// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rational_cubic.h"

#include <cassert>

namespace phongpd::internal {
namespace {

int SignOf(const Rational& x) { return CGAL::sign(x); }

// The remainder of a by b, b not 0.
RationalCubic Remainder(RationalCubic a, const RationalCubic& b) {
  const int n = b.Degree();
  for (int d = a.Degree(); d >= n; d = a.Degree()) {
    const auto top = static_cast<std::size_t>(d);
    const Rational factor = a.c[top] / b.c[static_cast<std::size_t>(n)];
    for (int k = 0; k < n; ++k) {
      a.c[static_cast<std::size_t>(d - n + k)] -=
          factor * b.c[static_cast<std::size_t>(k)];
    }
    a.c[top] = 0;
  }
  return a;
}

// a / b, which leaves nothing.
RationalCubic Quotient(RationalCubic a, const RationalCubic& b) {
  RationalCubic result;
  const int n = b.Degree();
  for (int d = a.Degree(); d >= n; d = a.Degree()) {
    const auto top = static_cast<std::size_t>(d);
    const Rational factor = a.c[top] / b.c[static_cast<std::size_t>(n)];
    result.c[static_cast<std::size_t>(d - n)] = factor;
    for (int k = 0; k < n; ++k) {
      a.c[static_cast<std::size_t>(d - n + k)] -=
          factor * b.c[static_cast<std::size_t>(k)];
    }
    a.c[top] = 0;
  }
  return result;
}

RationalCubic CommonDivisor(RationalCubic a, RationalCubic b) {
  while (!b.IsZero()) {
    RationalCubic rest = Remainder(a, b);
    a = b;
    b = rest;
  }
  return a;
}

RationalCubic Derivative(const RationalCubic& p) {
  RationalCubic d;
  for (int k = 1; k < 4; ++k) {
    d.c[static_cast<std::size_t>(k - 1)] =
        p.c[static_cast<std::size_t>(k)] * Rational(k);
  }
  return d;
}

// Sturm's sequence of a polynomial without double roots.
class SturmSequence {
 public:
  explicit SturmSequence(const RationalCubic& p) {
    terms_.push_back(p);
    RationalCubic next = Derivative(p);
    while (!next.IsZero()) {
      terms_.push_back(next);
      next = Remainder(terms_[terms_.size() - 2], terms_.back());
      for (Rational& c : next.c) c = -c;
    }
  }

  // In (a, b].
  int RootsBetween(const Rational& a, const Rational& b) const {
    return Changes(a) - Changes(b);
  }

 private:
  int Changes(const Rational& t) const {
    int changes = 0, last = 0;
    for (const RationalCubic& term : terms_) {
      const int sign = term.SignAt(t);
      if (sign == 0) continue;
      if (last != 0 && sign != last) ++changes;
      last = sign;
    }
    return changes;
  }

  std::vector<RationalCubic> terms_;
};

void Isolate(const RationalCubic& p, const SturmSequence& sturm,
             const Rational& a, const Rational& b,
             std::vector<CubicRoot>* roots) {
  const int count = sturm.RootsBetween(a, b);
  if (count == 0) return;
  if (count == 1) {
    // In (a, b]: at the end, or inside where signs differ, unless a is another.
    if (p.SignAt(b) == 0) {
      roots->push_back({p, b, b});
      return;
    }
    if (p.SignAt(a) != 0) {
      roots->push_back({p, a, b});
      return;
    }
  }
  const Rational middle = (a + b) / Rational(2);
  Isolate(p, sturm, a, middle, roots);
  Isolate(p, sturm, middle, b, roots);
}

}  // namespace

int RationalCubic::Degree() const {
  for (int k = 3; k >= 0; --k) {
    if (SignOf(c[static_cast<std::size_t>(k)]) != 0) return k;
  }
  return -1;
}

Rational RationalCubic::At(const Rational& t) const {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

int RationalCubic::SignAt(const Rational& t) const { return SignOf(At(t)); }

RationalCubic operator+(const RationalCubic& p, const RationalCubic& q) {
  RationalCubic sum = p;
  for (std::size_t k = 0; k < 4; ++k) sum.c[k] += q.c[k];
  return sum;
}

RationalCubic operator-(const RationalCubic& p, const RationalCubic& q) {
  RationalCubic sum = p;
  for (std::size_t k = 0; k < 4; ++k) sum.c[k] -= q.c[k];
  return sum;
}

RationalCubic operator*(const RationalCubic& p, const RationalCubic& q) {
  assert(p.Degree() + q.Degree() <= 3);
  RationalCubic product;
  for (int i = 0; i <= p.Degree(); ++i) {
    for (int j = 0; j <= q.Degree(); ++j) {
      product.c[static_cast<std::size_t>(i + j)] +=
          p.c[static_cast<std::size_t>(i)] * q.c[static_cast<std::size_t>(j)];
    }
  }
  return product;
}

RationalCubic operator*(const Rational& factor, const RationalCubic& p) {
  RationalCubic product = p;
  for (Rational& c : product.c) c *= factor;
  return product;
}

bool HasOneSign(const RationalCubic& p, const Rational& a, const Rational& b,
                int* sign) {
  // Of p(a + w s) by powers of s, then by Bernstein's polynomials, times 3.
  const Rational w = b - a;
  const Rational d0 = p.At(a);
  const Rational d1 =
      w * (p.c[1] + a * (Rational(2) * p.c[2] + a * Rational(3) * p.c[3]));
  const Rational d2 = w * w * (p.c[2] + Rational(3) * a * p.c[3]);
  const Rational d3 = w * w * w * p.c[3];
  const Rational three(3);
  *sign = SignOf(d0);
  return *sign != 0 && SignOf(three * d0 + d1) == *sign &&
         SignOf(three * d0 + Rational(2) * d1 + d2) == *sign &&
         SignOf(d0 + d1 + d2 + d3) == *sign;
}

void CubicRoot::Refine() {
  if (IsExact()) return;
  const Rational middle = (low + high) / Rational(2);
  const int sign = poly.SignAt(middle);
  if (sign == 0) {
    low = high = middle;
  } else if (sign == poly.SignAt(low)) {
    low = middle;
  } else {
    high = middle;
  }
}

std::vector<CubicRoot> RootsIn(const RationalCubic& p, const Rational& a,
                               const Rational& b) {
  std::vector<CubicRoot> roots;
  int sign = 0;
  if (p.Degree() < 1 || HasOneSign(p, a, b, &sign)) return roots;
  const RationalCubic simple = Quotient(p, CommonDivisor(p, Derivative(p)));
  if (simple.SignAt(a) == 0) roots.push_back({simple, a, a});
  Isolate(simple, SturmSequence(simple), a, b, &roots);
  return roots;
}

int SignAtRoot(const RationalCubic& q, CubicRoot* root) {
  if (q.IsZero()) return 0;
  int sign = 0;
  for (int step = 0;; ++step) {
    if (root->IsExact()) return q.SignAt(root->low);
    if (HasOneSign(q, root->low, root->high, &sign)) return sign;
    // A common root is one of the divisor, at which signs differ beside it.
    if (step == 4) {
      const RationalCubic common = CommonDivisor(root->poly, q);
      if (common.Degree() >= 1 &&
          common.SignAt(root->low) * common.SignAt(root->high) < 0) {
        return 0;
      }
    }
    root->Refine();
  }
}

}  // namespace phongpd::internal
