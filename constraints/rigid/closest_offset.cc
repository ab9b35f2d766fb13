// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/closest_offset.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "core/mesh/numbers.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using EdgeVectors = std::array<Vector3d, 3>;

// Of edges whose cross product is a direction, by their squares.
constexpr double kCrossing = 1e-20;

// Of a vector whose squares, divided by its largest, are exact to rounding.
constexpr double kLeastLength = 1e-290;

// v without what it has along d; v itself of an edge without length.
Vector3d Across(const Vector3d& v, const Vector3d& d) {
  const double squared = d.squaredNorm();
  return squared > 0.0 ? Vector3d(v - d * (d.dot(v) / squared)) : v;
}

EdgeVectors EdgeVectorsOf(const TriangleCorners& t) {
  return {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
}

// From q + [0, 1] e to p + [0, 1] d, and whether the points are inside of the
// two; any vector would be a direction.
struct OnSegments {
  Vector3d offset, on_first;
  bool is_inside_first, is_inside_second;
};

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
  const Vector3d along = s * d;
  return {r + along - t * e, p + along, s > 0.0 && s<1.0, t> 0.0 && t < 1.0};
}

class Closest {
 public:
  Closest(const TriangleCorners& a, const TriangleCorners& b)
      : a_(a), b_(b), e_(EdgeVectorsOf(a)), f_(EdgeVectorsOf(b)) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const OnSegments on = BetweenSegments(a_[i], e_[i], b_[j], f_[j]);
        if (!IsCloser(on.offset)) continue;
        on_first_ = on.on_first;
        first_ = on.is_inside_first ? &e_[i] : nullptr;
        second_ = on.is_inside_second ? &f_[j] : nullptr;
      }
    }
    OfferFace(a_, e_, b_, -1.0);
    OfferFace(b_, f_, a_, 1.0);
  }

  const Vector3d& offset() const { return offset_; }
  const Vector3d& on_first() const { return on_first_; }

  // Along the normal of the face, or across the edges that it is inside of.
  Vector3d Direction() const {
    if (is_face_) return normal_;
    if (first_ != nullptr && second_ != nullptr) {
      const Vector3d n = first_->cross(*second_);
      if (n.squaredNorm() >
          kCrossing * first_->squaredNorm() * second_->squaredNorm()) {
        return n.dot(offset_) < 0.0 ? Vector3d(-n) : n;
      }
    }
    if (first_ != nullptr) return Across(offset_, *first_);
    return second_ != nullptr ? Across(offset_, *second_) : offset_;
  }

 private:
  // Of the points over the face, from the face to them times the sign.
  void OfferFace(const TriangleCorners& face, const EdgeVectors& e,
                 const TriangleCorners& points, double sign) {
    const Vector3d n = e[0].cross(e[1]);
    const double squared = n.squaredNorm();
    if (!(squared > 0.0)) return;
    const Vector3d inward[3] = {n.cross(e[0]), n.cross(e[1]), n.cross(e[2])};
    for (const Vector3d& p : points) {
      bool is_over = true;
      for (std::size_t i = 0; i < 3; ++i) {
        is_over = is_over && inward[i].dot(p - face[i]) >= 0.0;
      }
      if (!is_over) continue;
      const double along = sign * n.dot(p - face[0]);
      const Vector3d offset = n * (along / squared);
      if (!IsCloser(offset)) continue;
      on_first_ = sign < 0.0 ? Vector3d(p + offset) : p;
      is_face_ = true;
      normal_ = along < 0.0 ? Vector3d(-n) : n;
    }
  }

  bool IsCloser(const Vector3d& offset) {
    const double squared = offset.squaredNorm();
    if (!(squared < best_)) return false;
    best_ = squared;
    offset_ = offset;
    return true;
  }

  const TriangleCorners &a_, &b_;
  const EdgeVectors e_, f_;
  double best_ = kInfinity;
  Vector3d offset_ = Vector3d::Zero(), on_first_ = Vector3d::Zero();
  bool is_face_ = false;
  Vector3d normal_ = Vector3d::Zero();
  const Vector3d *first_ = nullptr, *second_ = nullptr;  // edges
};

// 0 of what is so short that it has lost digits, or is not finite.
Vector3d UnitOf(const Vector3d& v) {
  const double most = v.cwiseAbs().maxCoeff();
  if (!(most > kLeastLength && most < kInfinity)) return Vector3d::Zero();
  const Vector3d scaled = v / most;
  return scaled / scaled.norm();
}

}  // namespace

ClosestOffset FindClosestOffset(const TriangleCorners& a,
                                const TriangleCorners& b) {
  const Closest closest(a, b);
  return {closest.offset(), UnitOf(closest.Direction()), closest.on_first()};
}

}  // namespace phongpd::internal
