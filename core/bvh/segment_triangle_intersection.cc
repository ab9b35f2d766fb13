// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/segment_triangle_intersection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/bvh/exact_sign.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

int Side(const Vector3d& a, const Vector3d& b, const Vector3d& c,
         const Vector3d& d) {
  return Orient3d(a.data(), b.data(), c.data(), d.data());
}

// x / (x − y) of two values of opposite sign or zero, in [0, 1]; 0 where
// rounding left both the same.
double Share(double x, double y) {
  const double share = x == y ? 0.0 : x / (x - y);
  return share >= 0.0 && share <= 1.0 ? share : (share > 1.0 ? 1.0 : 0.0);
}

// A segment and a triangle in one plane, seen along the axis w.
class Flat {
 public:
  Flat(int axis, const Corners& t, const Vector3d& a, const Vector3d& b)
      : u_((axis + 1) % 3), v_((axis + 2) % 3), t_(t), a_(a), b_(b) {}

  // Along this axis the triangle shows no area.
  bool IsHidden() const { return Turn(t_[0], t_[1], t_[2]) == 0; }

  bool Meets(double* fraction) const {
    if (Contains(a_)) {
      *fraction = 0.0;
      return true;
    }
    // The segment enters through an edge.
    bool meets = false;
    *fraction = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& p = t_[k];
      const Vector3d& q = t_[(k + 1) % 3];
      const int turn_a = Turn(p, q, a_), turn_b = Turn(p, q, b_);
      if (turn_a * turn_b > 0 || Turn(a_, b_, p) * Turn(a_, b_, q) > 0) {
        continue;
      }
      if (turn_a == 0 && turn_b == 0) {  // all four on one line
        // Then Contains(a) was false, so a is beyond p or beyond q, and the
        // first end the segment reaches is the nearer one.
        if (!Overlap(p, q)) continue;
        meets = true;
        *fraction = std::min(*fraction, std::min(Along(p), Along(q)));
        continue;
      }
      meets = true;
      *fraction = std::min(*fraction, Share(Area(p, q, a_), Area(p, q, b_)));
    }
    return meets;
  }

 private:
  int Turn(const Vector3d& p, const Vector3d& q, const Vector3d& r) const {
    return Orient2d(p[u_], p[v_], q[u_], q[v_], r[u_], r[v_]);
  }
  double Area(const Vector3d& p, const Vector3d& q, const Vector3d& r) const {
    return (q[u_] - p[u_]) * (r[v_] - p[v_]) -
           (q[v_] - p[v_]) * (r[u_] - p[u_]);
  }
  bool Contains(const Vector3d& x) const {
    const int i = Turn(t_[0], t_[1], x);
    const int j = Turn(t_[1], t_[2], x);
    const int k = Turn(t_[2], t_[0], x);
    return (i >= 0 && j >= 0 && k >= 0) || (i <= 0 && j <= 0 && k <= 0);
  }
  // Do the collinear segments ab and pq share a point?
  bool Overlap(const Vector3d& p, const Vector3d& q) const {
    for (const int c : {u_, v_}) {
      if (std::max(p[c], q[c]) < std::min(a_[c], b_[c]) ||
          std::max(a_[c], b_[c]) < std::min(p[c], q[c])) {
        return false;
      }
    }
    return true;
  }
  // Fraction of the way from a to b of a point on their line.
  double Along(const Vector3d& x) const {
    const int c =
        std::abs(b_[u_] - a_[u_]) > std::abs(b_[v_] - a_[v_]) ? u_ : v_;
    return std::clamp((x[c] - a_[c]) / (b_[c] - a_[c]), 0.0, 1.0);
  }

  int u_, v_;
  const Corners& t_;
  const Vector3d& a_;
  const Vector3d& b_;
};

bool MeetsInPlane(const Corners& t, const Vector3d& a, const Vector3d& b,
                  double* fraction) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).cwiseAbs();
  int axis = 0;
  normal.maxCoeff(&axis);
  for (int k = 0; k < 3; ++k) {
    const Flat flat((axis + k) % 3, t, a, b);
    if (!flat.IsHidden()) return flat.Meets(fraction);
  }
  return false;  // zero area
}

}  // namespace

bool MeetsTriangle(const Corners& t, const Vector3d& a, const Vector3d& b,
                   double* fraction) {
  const int side_a = Side(t[0], t[1], t[2], a);
  const int side_b = Side(t[0], t[1], t[2], b);
  if (side_a * side_b > 0) return false;
  if (side_a == 0 && side_b == 0) return MeetsInPlane(t, a, b, fraction);
  const int i = Side(a, b, t[0], t[1]);
  const int j = Side(a, b, t[1], t[2]);
  if (i * j < 0) return false;
  const int k = Side(a, b, t[2], t[0]);
  if (i * k < 0 || j * k < 0) return false;
  if (side_a == 0) {
    *fraction = 0.0;
  } else if (side_b == 0) {
    *fraction = 1.0;
  } else {
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    *fraction = Share(normal.dot(a - t[0]), normal.dot(b - t[0]));
  }
  return true;
}

}  // namespace phongpd
