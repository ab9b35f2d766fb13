// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/closest_offset.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "core/mesh/numbers.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Edges = std::array<Vector3d, 3>;

// Of edges whose cross product is a direction, by their squares.
constexpr double kCrossing = 1e-20;

// Of a vector whose squares, divided by its largest, are exact to rounding.
constexpr double kLeastLength = 1e-290;

// v without what it has along d; v itself of an edge without length.
Vector3d Across(const Vector3d& v, const Vector3d& d) {
  const double squared = d.squaredNorm();
  return squared > 0.0 ? Vector3d(v - d * (d.dot(v) / squared)) : v;
}

// Two points of segments, as shares of them.
struct OnSegments {
  Vector3d offset;
  bool is_inside_first, is_inside_second;
};

// From q + [0, 1] e to p + [0, 1] d; any vector would be a direction.
OnSegments BetweenSegments(const Vector3d& p, const Vector3d& d,
                           const Vector3d& q, const Vector3d& e) {
  const Vector3d r = p - q;
  const double a = d.squaredNorm(), b = d.dot(e), c = e.squaredNorm();
  const double along_d = d.dot(r), along_e = e.dot(r);
  const double den = a * c - b * b;
  double s = 0.0;
  if (den > 1e-14 * a * c) {
    s = std::clamp((b * along_e - c * along_d) / den, 0.0, 1.0);
  }
  double t = c > 0.0 ? (b * s + along_e) / c : 0.0;
  if (t < 0.0) {
    t = 0.0;
    s = a > 0.0 ? std::clamp(-along_d / a, 0.0, 1.0) : 0.0;
  } else if (t > 1.0) {
    t = 1.0;
    s = a > 0.0 ? std::clamp((b - along_d) / a, 0.0, 1.0) : 0.0;
  }
  return {r + s * d - t * e, s > 0.0 && s<1.0, t> 0.0 && t < 1.0};
}

// Across the edges that it is inside of.
Vector3d DirectionOf(const OnSegments& on, const Vector3d& d,
                     const Vector3d& e) {
  if (on.is_inside_first && on.is_inside_second) {
    const Vector3d n = d.cross(e);
    if (n.squaredNorm() > kCrossing * d.squaredNorm() * e.squaredNorm()) {
      return n.dot(on.offset) < 0.0 ? Vector3d(-n) : n;
    }
  }
  if (on.is_inside_first) return Across(on.offset, d);
  return on.is_inside_second ? Across(on.offset, e) : on.offset;
}

class Closest {
 public:
  void OfferEdges(const Vector3d& p, const Vector3d& d, const Vector3d& q,
                  const Vector3d& e) {
    const OnSegments on = BetweenSegments(p, d, q, e);
    if (IsCloser(on.offset)) found_ = {on.offset, DirectionOf(on, d, e)};
  }

  // Of the points over the face, from the face to them times the sign.
  void OfferFace(const TriangleCorners& face, const Edges& e,
                 const TriangleCorners& points, double sign) {
    const Vector3d n = e[0].cross(e[1]);
    const double squared = n.squaredNorm();
    if (!(squared > 0.0)) return;
    for (const Vector3d& p : points) {
      bool is_over = true;
      for (std::size_t i = 0; i < 3; ++i) {
        is_over = is_over && n.cross(e[i]).dot(p - face[i]) >= 0.0;
      }
      if (!is_over) continue;
      const double along = sign * n.dot(p - face[0]);
      const Vector3d offset = n * (along / squared);
      if (IsCloser(offset)) found_ = {offset, along < 0.0 ? Vector3d(-n) : n};
    }
  }

  const ClosestOffset& found() const { return found_; }

 private:
  bool IsCloser(const Vector3d& offset) {
    const double squared = offset.squaredNorm();
    if (!(squared < best_)) return false;
    best_ = squared;
    return true;
  }

  double best_ = kInfinity;
  ClosestOffset found_;
};

// 0 of what is so short that it has lost digits, or is not finite.
Vector3d UnitOf(const Vector3d& v) {
  const double most = v.cwiseAbs().maxCoeff();
  if (!(most > kLeastLength && most < kInfinity)) return Vector3d::Zero();
  const Vector3d scaled = v / most;
  return scaled / scaled.norm();
}

Edges EdgesOf(const TriangleCorners& t) {
  return {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
}

}  // namespace

ClosestOffset FindClosestOffset(const TriangleCorners& a,
                                const TriangleCorners& b) {
  const Edges e = EdgesOf(a), f = EdgesOf(b);
  Closest closest;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      closest.OfferEdges(a[i], e[i], b[j], f[j]);
    }
  }
  closest.OfferFace(a, e, b, -1.0);
  closest.OfferFace(b, f, a, 1.0);
  ClosestOffset found = closest.found();
  found.direction = UnitOf(found.direction);
  return found;
}

}  // namespace phongpd::internal
