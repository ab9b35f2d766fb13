// SPDX-License-Identifier: GPL-3.0-or-later
// Where a point lies.
#include "core/bvh/exact_sign.h"
#include "core/bvh/triangle_bvh.h"
#include "core/mesh/finite.h"
#include "core/mesh/numbers.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

using internal::Sign;

// Sign of the turn a, b, q + (ε, ε²) given the unperturbed one: the derivative
// of the determinant by q_x is a_y − b_y, by q_y it is b_x − a_x.
int Perturbed(int sign, const Vector3d& a, const Vector3d& b) {
  if (sign != 0) return sign;
  sign = Sign(a.y() - b.y());
  return sign != 0 ? sign : Sign(b.x() - a.x());
}

// Is q, known to lie in the triangle's plane, in the closed triangle?  Seen
// along axis; false if the triangle is degenerate from there.
bool ContainsSeenAlong(int axis, const Vector3d& a, const Vector3d& b,
                       const Vector3d& c, const Vector3d& q) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int ab = Orient2d(a[u], a[v], b[u], b[v], q[u], q[v]);
  const int bc = Orient2d(b[u], b[v], c[u], c[v], q[u], q[v]);
  const int ca = Orient2d(c[u], c[v], a[u], a[v], q[u], q[v]);
  if (ab == 0 && bc == 0 && ca == 0) return false;
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

enum class Crossing { kNone, kOut, kIn, kTouch };

// What the ray from q along ±z does with triangle a, b, c: leaves, enters.
Crossing Cross(const Vector3d& a, const Vector3d& b, const Vector3d& c,
               const Vector3d& q, bool upward) {
  const int ab = Orient2d(a.x(), a.y(), b.x(), b.y(), q.x(), q.y());
  const int bc = Orient2d(b.x(), b.y(), c.x(), c.y(), q.x(), q.y());
  if (ab * bc < 0) return Crossing::kNone;
  const int ca = Orient2d(c.x(), c.y(), a.x(), a.y(), q.x(), q.y());
  if (ab * ca < 0 || bc * ca < 0) return Crossing::kNone;
  if (ab == 0 && bc == 0 && ca == 0) {  // vertical: only q on it matters
    return ContainsSeenAlong(0, a, b, c, q) || ContainsSeenAlong(1, a, b, c, q)
               ? Crossing::kTouch
               : Crossing::kNone;
  }
  const int side = Orient3d(a.data(), b.data(), c.data(), q.data());
  if (side == 0) return Crossing::kTouch;
  const int turn = Perturbed(ab, a, b);
  if (turn != Perturbed(bc, b, c) || turn != Perturbed(ca, c, a)) {
    return Crossing::kNone;
  }
  if ((side != turn) != upward) return Crossing::kNone;
  return (turn > 0) == upward ? Crossing::kOut : Crossing::kIn;
}

}  // namespace

TriangleBvh::Winding TriangleBvh::FindWinding(const Vector3d& q) const {
  Winding found;
  if (!IsFinite(q) || tree_.nodes().empty()) return found;
  const BoxTree::Node& root = tree_.nodes().front();
  if ((q.array() < root.min.array()).any() ||
      (q.array() > root.max.array()).any()) {
    return found;
  }
  // The shorter way out meets fewer boxes.
  const bool upward = root.max.z() - q.z() < q.z() - root.min.z();
  tree_.ForEach(
      [&](int index) {
        const BoxTree::Node& node = tree_.nodes()[index];
        return node.min.x() <= q.x() && q.x() <= node.max.x() &&
               node.min.y() <= q.y() && q.y() <= node.max.y() &&
               (upward ? node.max.z() >= q.z() : node.min.z() <= q.z());
      },
      [&](int position) {
        const TriangleCorners& t = corners_[position];
        const Crossing crossing = Cross(t[0], t[1], t[2], q, upward);
        found.on_surface = crossing == Crossing::kTouch;
        found.number += crossing == Crossing::kOut ? 1 : 0;
        found.number -= crossing == Crossing::kIn ? 1 : 0;
        return !found.on_surface;
      });
  return found;
}

Location TriangleBvh::Locate(const Vector3d& q) const {
  const Winding winding = FindWinding(q);
  if (winding.on_surface) return Location::kOnSurface;
  return winding.number % 2 != 0 ? Location::kInside : Location::kOutside;
}

int TriangleBvh::WindingNumber(const Vector3d& q) const {
  const Winding winding = FindWinding(q);
  return winding.on_surface ? 0 : winding.number;
}

}  // namespace phongpd
