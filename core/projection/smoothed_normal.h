// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"

namespace phongpd {

// The gradient of smoothed occupancy at a point.
struct SmoothedNormal {
  // G_ρ(x)/ρ², without unit; zero where C_cont is not within ρ.
  Eigen::Vector3d integral = Eigen::Vector3d::Zero();
  // By how much rounding may have moved it, about.
  double rounding = 0.0;

  // Of two parts of a surface, at one point with one ρ.
  SmoothedNormal& operator+=(const SmoothedNormal& other) {
    integral += other.integral;
    rounding += other.rounding;
    return *this;
  }

  // Is the direction known, to 1e-6 rad by that?  Not beyond ρ, nor where what
  // lies within ρ is symmetric and cancels.
  bool HasDirection() const {
    return integral.norm() > kKnown * rounding &&
           integral.norm() > std::numeric_limits<double>::min();
  }
  // Outward, of length 1; zero without one.
  Eigen::Vector3d Direction() const {
    return HasDirection() ? Eigen::Vector3d(integral.stableNormalized())
                          : Eigen::Vector3d::Zero();
  }

  static constexpr double kKnown = 1e6;
};

// The normals of C_cont within ρ of a point, weighted by how near they are (not
// those of walls that close a part of it, ContactKind::kNone):
//
//   G_ρ(x) = ∮_{C_cont} w(|p − x|) n dA,   w(r) = (1 − r²/ρ²)² for r < ρ, or 0
//
// n outward.  By the theorem of Gauss it is −∇ of the volume of C_obj within ρ
// of x, each part weighted by w: what points out of it most steeply.  It
// depends on the shape alone, not on how it is cut into triangles, and is
// continuous in x and wherever C_cont moves continuously.
//
// Exact but for rounding.  On a triangle's plane, at the height h over x,
// w = (R² − s²)²/ρ⁴ with R² = ρ² − h² and s the distance to the foot of x.  In
// polar coordinates around the foot the triangle is the (signed) sum of the
// wedges its edges span:
//
//   ∫ w dA = Σ_edges ∫ F(min(s, R)) dθ,   F(s) = ∫₀ˢ (R² − t²)²/ρ⁴ t dt
//
// On an edge at the signed distance d from the foot s² = d² + y² and
// dθ = d/s² dy, y along the edge.  6ρ⁴F = s²(3R⁴ − 3R²s² + s⁴): so inside the
// disc a polynomial in y, outside R⁶ times the angle.  Nothing divides by what
// may vanish: x may lie on planes, edges and vertices.
//
// Queries are const, thread-safe, do not allocate, and take time with the
// triangles that meet the sphere of radius ρ: what lies within it is summed by
// subtrees.
class SmoothedNormals {
 public:
  // ρ, user's unit.  Throws InputError unless it is finite and at least 1e-9
  // of the space's diagonal.
  SmoothedNormals(const ContactSpace& space, double radius);
  // Of a part of C_cont, which need not be closed: triangles of a tree, at
  // least one, and their outward unit normals, zero where one counts for
  // nothing.  What parts give adds up.  ρ as it is: finite and > 0.
  SmoothedNormals(std::shared_ptr<const TriangleBvh> part,
                  std::vector<Eigen::Vector3d> normals, double radius);
  ~SmoothedNormals();
  SmoothedNormals(SmoothedNormals&&) noexcept;
  SmoothedNormals& operator=(SmoothedNormals&&) noexcept;

  // Finite x and x − centre of the space (zero, without a direction, else).
  SmoothedNormal At(const Eigen::Vector3d& x) const noexcept;

  // ∂(integral)/∂x of that, entry (i, j) of coordinate i by x_j; 1/user's unit:
  //
  //   ∂G_ρ/∂x = 4/ρ² ∮ (1 − r²/ρ²) n (p − x)ᵀ dA   over r < ρ
  //
  // continuous in x, since w is differentiable where it ends, and symmetric
  // where all of C_cont within ρ is there.  In a plane, p − x = h n + s with s
  // from the foot of x: of the first part the integral is as above, with
  // ∫₀ˢ (R² − t²) t dt, and of the second −¼ Σ_edges ν ∫ (R² − s²)² dy over
  // what the disc has of the edge, ν its outward normal: a polynomial.  Zero
  // where x is not finite.
  Eigen::Matrix3d DerivativeAt(const Eigen::Vector3d& x) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
