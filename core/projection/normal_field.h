// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/projection/phong_field.h"

namespace phongpd {

// A point x = p(λ) + s·n(λ) of an offset prism.
struct NormalHit {
  Eigen::Vector3d lambda = Eigen::Vector3d::Zero();  // ≥ 0, sums to 1
  double s = 0.0;
};

// One triangle of a Phong field with interpolated normals: the offset prism
//
//   p(λ) = q₀ + λ₁e₁ + λ₂e₂,   n(λ) = n₀ + λ₁d₁ + λ₂d₂   (not normalised)
//
// For fixed s the points p(λ) + s n(λ) fill a flat triangle, so x lies in it
// only if
//
//   f(s) = det[x₀ + s n₀, e₁ + s d₁, e₂ + s d₂] = 0,   x₀ = q₀ − x,
//
// a cubic whose coefficients are f(s) = x₀·N + s (n₀·N + x₀·M)
// + s² (n₀·M + x₀·K) + s³ n₀·K with N = e₁×e₂, M = d₁×e₂ + e₁×d₂, K = d₁×d₂.
// At a root f'(s) = det J, J = [e₁ + s d₁, e₂ + s d₂, n(λ)] (columns, the
// derivative of x by λ₁, λ₂, s): roots of one sign of det J are one sheet,
// and det J = 0 is a fold.  Field frame (lengths of order 1).
struct OffsetPrism {
  Eigen::Vector3d q0, e1, e2;
  Eigen::Vector3d n0, d1, d2;
  Eigen::Vector3d cross_n, cross_m, cross_k;  // N, M, K
  double n0_n = 0.0, n0_m = 0.0, n0_k = 0.0;
  double min_norm = 0.0;  // least |n(λ)| on the triangle
  // For Narrow.  Of n(λ)·N on the triangle 1/most and 1/least (0, 0 where N is
  // too short beside them to tell), and by how much s rounds there.
  double over_most_n = 0.0, over_least_n = 0.0, plane_slack = 0.0;
  double reach = 0.0, turn = 0.0;  // longest |e|, largest |d|
  int u = 0, v = 1;  // axes of a plane on which triangles turn left

  OffsetPrism() = default;
  OffsetPrism(const std::array<Eigen::Vector3d, 3>& corners,
              const std::array<Eigen::Vector3d, 3>& normals);

  Eigen::Vector3d Point(const Eigen::Vector3d& lambda) const {
    return q0 + lambda[1] * e1 + lambda[2] * e2;
  }
  Eigen::Vector3d Normal(const Eigen::Vector3d& lambda) const {
    return n0 + lambda[1] * d1 + lambda[2] * d2;
  }
  // Columns: derivatives of p(λ) + s n(λ) by λ₁, λ₂ and s.
  Eigen::Matrix3d Jacobian(const NormalHit& hit) const;
  // d = s|n(λ)|, negative inside.
  double SignedDepth(const NormalHit& hit) const {
    return hit.s * Normal(hit.lambda).norm();
  }
  // ∇d = |n|∇s + s(n̂·d₁)∇λ₁ + s(n̂·d₂)∇λ₂; the unit normal where J is
  // singular, zero where n is.
  Eigen::Vector3d DepthGradient(const NormalHit& hit) const;

  // All projections of x with s in [s_min, s_max] (ends widened by rounding),
  // ascending in s.  λ may be negative by rounding only – at most 1e-9, and
  // less the better the offset triangle is shaped – and is then moved onto the
  // triangle.  Where the offset triangle has collapsed to a segment or point
  // that contains x, one of its λ is given.
  int Project(const Eigen::Vector3d& x, double s_min, double s_max,
              std::array<NormalHit, 3>* hits) const noexcept;

  // Shrinks [*s_min, *s_max] to what can hold a hit of Project, and is false
  // where nothing can.  As p(λ) lies in the triangle's plane,
  // s·n(λ)·N = (x − q₀)·N: that bounds s.  Seen along an axis, x then lies on
  // the same side of each moving edge throughout, or it may not be beyond it.
  // Beyond by the tolerances of Project does not count.
  bool Narrow(const Eigen::Vector3d& x, double* s_min,
              double* s_max) const noexcept;
};

// Newton on x = p(λ) + s n(λ), from *hit and without regard to λ ≥ 0.  True
// if the residual fell below 1e-12 (field frame).
bool RefineHit(const OffsetPrism& prism, const Eigen::Vector3d& x,
               int iterations, NormalHit* hit) noexcept;

// The prisms of all triangles of `field`, in its order.
std::vector<OffsetPrism> BuildOffsetPrisms(const PhongField& field);

}  // namespace phongpd
