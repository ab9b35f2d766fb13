// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/translated_triangles.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Interval = CGAL::Interval_nt<false>;  // under Rounding only
using Rounding = CGAL::Protect_FPU_rounding<true>;
using Rational = CGAL::Gmpq;

// Products of four coordinates below this stay finite; beyond, rationals.
constexpr double kLargest = 1e70;

enum class Answer { kNo, kYes, kUnknown };

template <typename Number>
struct Vector {
  Number x, y, z;

  Vector operator-(const Vector& o) const {
    return {x - o.x, y - o.y, z - o.z};
  }
  Vector operator+(const Vector& o) const {
    return {x + o.x, y + o.y, z + o.z};
  }
};

template <typename Number>
Vector<Number> Make(const Vector3d& v) {
  return {Number(v.x()), Number(v.y()), Number(v.z())};
}

template <typename Number>
Number Dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename Number>
Vector<Number> Cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Rational Least(const Rational& a, const Rational& b) { return a < b ? a : b; }
Rational Most(const Rational& a, const Rational& b) { return a < b ? b : a; }
Interval Least(const Interval& a, const Interval& b) {
  return {std::min(a.inf(), b.inf()), std::min(a.sup(), b.sup())};
}
Interval Most(const Interval& a, const Interval& b) {
  return {std::max(a.inf(), b.inf()), std::max(a.sup(), b.sup())};
}

Answer IsLess(const Rational& a, const Rational& b) {
  return a < b ? Answer::kYes : Answer::kNo;
}
Answer IsLess(const Interval& a, const Interval& b) {
  if (a.sup() < b.inf()) return Answer::kYes;
  return a.inf() >= b.sup() ? Answer::kNo : Answer::kUnknown;
}

// Sign of x; `known` says whether it is certain.
int SignOf(const Rational& x, bool*) { return static_cast<int>(CGAL::sign(x)); }
int SignOf(const Interval& x, bool* known) {
  if (x.inf() > 0.0) return 1;
  if (x.sup() < 0.0) return -1;
  if (x.inf() != 0.0 || x.sup() != 0.0) *known = false;
  return 0;
}

bool IsModerate(const Vector3d& v) {
  return v.cwiseAbs().maxCoeff() < kLargest;
}
bool IsModerate(const Corners& t) {
  return IsModerate(t[0]) && IsModerate(t[1]) && IsModerate(t[2]);
}

// A + p + [0, d] against B, seen from the first corner of A + p.
template <typename Number>
class MovingPair {
 public:
  MovingPair(const Corners& a, const Corners& b, const Vector3d& p,
             const Vector3d& p2)
      : d_(Make<Number>(p2) - Make<Number>(p)),
        v_(Make<Number>(b[0]) - Make<Number>(a[0]) - Make<Number>(p)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      a_[k] = Make<Number>(a[next]) - Make<Number>(a[k]);
      b_[k] = Make<Number>(b[next]) - Make<Number>(b[k]);
    }
  }

  // kYes: some axis separates them; kNo: none does.
  Answer Separated() const {
    const Vector<Number> normal = Cross(a_[0], a_[1]);
    Answer answer = Answer::kNo;
    const auto try_axis = [&](const Vector<Number>& axis) {
      const Answer one = SeparatedAlong(axis);
      if (one != Answer::kNo) answer = one;
      return one == Answer::kYes;
    };
    if (try_axis(normal) || try_axis(Cross(b_[0], b_[1]))) return answer;
    for (const Vector<Number>& e : a_) {
      if (try_axis(Cross(e, d_))) return answer;
    }
    for (const Vector<Number>& e : b_) {
      if (try_axis(Cross(e, d_))) return answer;
    }
    for (const Vector<Number>& e : a_) {
      for (const Vector<Number>& f : b_) {
        if (try_axis(Cross(e, f))) return answer;
      }
    }
    // Where all lies in parallel planes.  Elsewhere these only cost time.
    for (const Vector<Number>& e : a_) {
      if (try_axis(Cross(normal, e))) return answer;
    }
    for (const Vector<Number>& e : b_) {
      if (try_axis(Cross(normal, e))) return answer;
    }
    try_axis(Cross(normal, d_));
    return answer;
  }

 private:
  // kUnknown must not hide behind a later kNo, but a later kYes wins.
  Answer SeparatedAlong(const Vector<Number>& n) const {
    const Number zero(0.0);
    const Number a1 = Dot(n, a_[0]), a2 = -Dot(n, a_[2]);
    const Number b1 = Dot(n, b_[0]), b2 = -Dot(n, b_[2]);
    const Number moved = Dot(n, d_), apart = Dot(n, v_);
    const Answer below = IsLess(Most(zero, Most(a1, a2)) + Most(zero, moved),
                                apart + Least(zero, Least(b1, b2)));
    if (below == Answer::kYes) return below;
    const Answer above =
        IsLess(apart + Most(zero, Most(b1, b2)),
               Least(zero, Least(a1, a2)) + Least(zero, moved));
    return above == Answer::kNo ? below : above;
  }

  Vector<Number> d_, v_;
  Vector<Number> a_[3], b_[3];  // edges, corner k to k + 1
};

template <typename Number>
bool IsDegenerateIn(const Corners& t, bool* known) {
  const Vector<Number> first = Make<Number>(t[0]);
  const Vector<Number> n =
      Cross(Make<Number>(t[1]) - first, Make<Number>(t[2]) - first);
  bool zero = true;
  for (const Number& x : {n.x, n.y, n.z}) {
    bool is_known = true;
    const int sign = SignOf(x, &is_known);
    if (sign != 0) {
      *known = true;
      return false;
    }
    zero = zero && is_known;
  }
  *known = zero;
  return true;
}

template <typename Number>
int CrossingIn(const Corners& t, const Vector3d& v, const Vector3d& q, int s,
               bool* known) {
  const Vector<Number> x = s > 0 ? Make<Number>(v) + Make<Number>(q)
                                 : Make<Number>(v) - Make<Number>(q);
  Vector<Number> r[3];
  for (std::size_t k = 0; k < 3; ++k) r[k] = Make<Number>(t[k]) - x;
  int turn = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    // On which side of the edge, seen from above, the moved point lies.
    int side = SignOf(r[k].x * r[next].y - r[k].y * r[next].x, known);
    if (!*known) return 0;
    if (side == 0) {
      const Vector3d &from = t[k], &to = t[next];
      if (from.y() != to.y()) {
        side = from.y() > to.y() ? 1 : -1;
      } else if (from.x() != to.x()) {
        side = from.x() < to.x() ? 1 : -1;
      }
    }
    if (side == 0 || (k > 0 && side != turn)) return 0;
    turn = side;
  }
  const int above = SignOf(Dot(Cross(r[0], r[1]), r[2]), known);
  return above == turn ? turn : 0;
}

}  // namespace

bool IsDegenerate(const Corners& t) {
  bool known = false;
  if (IsModerate(t)) {
    const Rounding rounding;
    const bool degenerate = IsDegenerateIn<Interval>(t, &known);
    if (known) return degenerate;
  }
  return IsDegenerateIn<Rational>(t, &known);
}

bool MeetWhileMoving(const Corners& a, const Corners& b, const Vector3d& p,
                     const Vector3d& p2) {
  if (IsModerate(a) && IsModerate(b) && IsModerate(p) && IsModerate(p2)) {
    const Rounding rounding;
    const Answer separated = MovingPair<Interval>(a, b, p, p2).Separated();
    if (separated != Answer::kUnknown) return separated == Answer::kNo;
  }
  return MovingPair<Rational>(a, b, p, p2).Separated() == Answer::kNo;
}

std::array<double, 2> MeetingFractions(const Corners& a, const Corners& b,
                                       const Vector3d& p, const Vector3d& p2) {
  double from = 0.0, to = 1.0;
  const Vector3d d = p2 - p;
  const auto clip = [&](const Vector3d& n) {
    double low_a = std::numeric_limits<double>::infinity(), high_a = -low_a;
    double low_b = low_a, high_b = -low_a;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at_a = n.dot(a[k] - a[0]), at_b = n.dot(b[k] - a[0] - p);
      low_a = std::min(low_a, at_a), high_a = std::max(high_a, at_a);
      low_b = std::min(low_b, at_b), high_b = std::max(high_b, at_b);
    }
    const double speed = n.dot(d);
    if (speed == 0.0) return;
    const double t1 = (low_b - high_a) / speed, t2 = (high_b - low_a) / speed;
    if (!std::isfinite(t1) || !std::isfinite(t2)) return;
    from = std::max(from, std::min(t1, t2));
    to = std::min(to, std::max(t1, t2));
  };
  const Vector3d normal = (a[1] - a[0]).cross(a[2] - a[0]);
  clip(normal);
  clip((b[1] - b[0]).cross(b[2] - b[0]));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d e = a[(i + 1) % 3] - a[i];
    clip(normal.cross(e));
    clip(normal.cross(b[(i + 1) % 3] - b[i]));
    for (std::size_t j = 0; j < 3; ++j) clip(e.cross(b[(j + 1) % 3] - b[j]));
  }
  from = std::min(from, 1.0);
  return {from, std::max(from, to)};
}

int UpwardCrossing(const Corners& t, const Vector3d& v, const Vector3d& q,
                   int s) {
  if (IsModerate(t) && IsModerate(v) && IsModerate(q)) {
    const Rounding rounding;
    bool known = true;
    const int crossing = CrossingIn<Interval>(t, v, q, s, &known);
    if (known) return crossing;
  }
  bool known = true;
  return CrossingIn<Rational>(t, v, q, s, &known);
}

}  // namespace phongpd::internal
