// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/curve_hull.h"

#include <CGAL/Interval_nt.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using HullInterval = CGAL::Interval_nt<false>;  // under HullRounding only
using HullRounding = CGAL::Protect_FPU_rounding<true>;

// n · (x − y), x and y of boxes.
HullInterval Height(const Vector3d& n, const Vector3d& x_low,
                    const Vector3d& x_high, const Vector3d& y_low,
                    const Vector3d& y_high) {
  HullInterval sum(0.0);
  for (int k = 0; k < 3; ++k) {
    sum += HullInterval(n[k]) * (HullInterval(x_low[k], x_high[k]) -
                                 HullInterval(y_low[k], y_high[k]));
  }
  return sum;
}

// Is n · (b − a − q) > 0 for all a, b of the triangles and q of the hull?
bool IsProved(const Vector3d& n, const Corners& a, const Corners& b,
              const CurveHull& hull) {
  const HullRounding rounding;
  // From one corner of each: few digits are lost.
  HullInterval gap(0.0);
  for (int k = 0; k < 3; ++k) {
    gap += HullInterval(n[k]) * (HullInterval(b[0][k]) - HullInterval(a[0][k]) -
                                 HullInterval(hull.low(0)[k], hull.high(0)[k]));
  }
  double least_b = 0.0, most_a = 0.0, most_q = 0.0;
  for (std::size_t i = 1; i < 3; ++i) {
    least_b = std::min(least_b, Height(n, b[i], b[i], b[0], b[0]).inf());
    most_a = std::max(most_a, Height(n, a[i], a[i], a[0], a[0]).sup());
  }
  for (int i = 1; i < hull.size(); ++i) {
    most_q = std::max(
        most_q,
        Height(n, hull.low(i), hull.high(i), hull.low(0), hull.high(0)).sup());
  }
  const HullInterval least =
      gap + HullInterval(least_b) - HullInterval(most_a) - HullInterval(most_q);
  return least.inf() > 0.0;
}

// The same to rounding, along a unit axis: finds the axis only.
class AxisSearch {
 public:
  AxisSearch(const Corners& a, const Corners& b, const CurveHull& hull)
      : a_(a), b_(b), hull_(hull) {
    best_.is_apart = false;
    best_.gap = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < hull.size(); ++i) points_[i] = hull.At(i);
    apart_ = b[0] - a[0] - points_[0];
  }

  // True as soon as an axis is proved.
  bool Try(const Vector3d& direction) {
    const double length = direction.stableNorm();
    if (!(length > 0.0)) return false;
    const Vector3d n = direction / length;
    double least_b = 0.0, most_b = 0.0, least_a = 0.0, most_a = 0.0;
    double least_q = 0.0, most_q = 0.0;
    for (std::size_t i = 1; i < 3; ++i) {
      const double b = n.dot(b_[i] - b_[0]), a = n.dot(a_[i] - a_[0]);
      least_b = std::min(least_b, b), most_b = std::max(most_b, b);
      least_a = std::min(least_a, a), most_a = std::max(most_a, a);
    }
    for (int i = 1; i < hull_.size(); ++i) {
      const double q = n.dot(points_[i] - points_[0]);
      least_q = std::min(least_q, q), most_q = std::max(most_q, q);
    }
    const double apart = n.dot(apart_);
    const double above = apart + least_b - most_a - most_q;
    const double below = -apart - most_b + least_a + least_q;
    const double gap = std::max(above, below);
    const Vector3d towards = above >= below ? n : Vector3d(-n);
    if (gap > best_.gap) {
      best_.gap = gap;
      best_.axis = -towards;
    }
    if (!(gap > 0.0) || !IsProved(towards, a_, b_, hull_)) return false;
    best_ = {true, gap, -towards};
    return true;
  }

  const HullGap& best() const { return best_; }

 private:
  const Corners &a_, &b_;
  const CurveHull& hull_;
  CurvePiece::Points points_;
  Vector3d apart_;
  HullGap best_;
};

}  // namespace

CurveHull::CurveHull(const CurvePiece& piece) : size_(piece.degree() + 1) {
  for (int i = 0; i < size_; ++i) low_[i] = high_[i] = piece.point(i);
}

std::array<CurveHull, 2> CurveHull::Halves() const {
  std::array<CurveHull, 2> halves = {*this, *this};
  const HullRounding rounding;
  for (int k = 0; k < 3; ++k) {
    std::array<HullInterval, CurvePiece::kMaxDegree + 1> p;
    for (int i = 0; i < size_; ++i)
      p[i] = HullInterval(low_[i][k], high_[i][k]);
    for (int left = size_ - 1; left > 0; --left) {
      for (int i = 0; i < left; ++i) {
        p[i] = (p[i] + p[i + 1]) * HullInterval(0.5);
      }
      const int first = size_ - left, second = left - 1;
      halves[0].low_[first][k] = p[0].inf();
      halves[0].high_[first][k] = p[0].sup();
      halves[1].low_[second][k] = p[second].inf();
      halves[1].high_[second][k] = p[second].sup();
    }
  }
  return halves;
}

CurveHull CurveHull::MovedBy(const Vector3d& v) const {
  CurveHull moved = *this;
  const HullRounding rounding;
  for (int i = 0; i < size_; ++i) {
    for (int k = 0; k < 3; ++k) {
      const HullInterval x =
          HullInterval(low_[i][k], high_[i][k]) + HullInterval(v[k]);
      moved.low_[i][k] = x.inf();
      moved.high_[i][k] = x.sup();
    }
  }
  return moved;
}

HullGap FindHullGap(const Corners& a, const Corners& b, const CurveHull& hull) {
  AxisSearch search(a, b, hull);
  for (int k = 0; k < 3; ++k) {
    if (search.Try(Vector3d::Unit(k))) return search.best();
  }
  const Vector3d chord = hull.At(hull.size() - 1) - hull.At(0);
  std::array<Vector3d, 3> edges_a, edges_b;
  for (std::size_t i = 0; i < 3; ++i) {
    edges_a[i] = a[(i + 1) % 3] - a[i];
    edges_b[i] = b[(i + 1) % 3] - b[i];
  }
  const Vector3d normal_a = edges_a[0].cross(edges_a[1]);
  const Vector3d normal_b = edges_b[0].cross(edges_b[1]);
  if (search.Try(normal_a) || search.Try(normal_b)) return search.best();
  for (const Vector3d& e : edges_a) {
    for (const Vector3d& f : edges_b) {
      if (search.Try(e.cross(f))) return search.best();
    }
  }
  for (const auto* edges : {&edges_a, &edges_b}) {
    for (const Vector3d& e : *edges) {
      // Where all lies in a plane, also along it.
      if (search.Try(e.cross(chord)) || search.Try(normal_a.cross(e)) ||
          search.Try(normal_b.cross(e))) {
        return search.best();
      }
    }
  }
  search.Try(normal_a.cross(chord));
  return search.best();
}

}  // namespace phongpd::internal
