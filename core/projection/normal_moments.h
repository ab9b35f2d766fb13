// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/bvh/triangle_corners.h"

namespace phongpd::internal {

// Of a set of triangles, with r = p − c for a point c of one's choice:
//
//   ∫ n dA,  ∫ n r dA,  ∫ n r rᵀ dA,  ∫ n |r|² r dA,  ∫ n |r|⁴ dA
//
// for each coordinate of n, and ∫ dA.  They give ∫ n w(|p − x|) dA exactly for
// every x, where w is a polynomial of degree 2 in the squared distance.
class NormalMoments {
 public:
  NormalMoments() = default;  // of nothing, around any point
  // Corners relative to c, unit normal.
  NormalMoments(const TriangleCorners& corners, const Eigen::Vector3d& normal);

  // The same around c − t.
  NormalMoments Shifted(const Eigen::Vector3d& t) const;
  NormalMoments& operator+=(const NormalMoments& other);

  // ∫ n (1 − k²|r + t|²)² dA: around x where t = c − x.
  Eigen::Vector3d Weighted(const Eigen::Vector3d& t, double k) const {
    Eigen::Vector3d sum;
    for (int i = 0; i < 3; ++i) {
      const Of& m = of_[static_cast<std::size_t>(i)];
      const double k2 = k * k;
      sum[i] = m.one - 2.0 * k2 * m.Square(t) + k2 * k2 * m.Fourth(t);
    }
    return sum;
  }
  // ∫ n (1 − k²|r + t|²) (r + t)ᵀ dA.
  Eigen::Matrix3d WeightedOffsets(const Eigen::Vector3d& t, double k) const {
    Eigen::Matrix3d sum;
    for (int i = 0; i < 3; ++i) {
      const Of& m = of_[static_cast<std::size_t>(i)];
      sum.row(i) = (m.r + m.one * t - k * k * m.Cube(t)).transpose();
    }
    return sum;
  }
  double area() const { return area_; }

 private:
  // Of one coordinate of n.
  struct Of {
    double one = 0.0;
    Eigen::Vector3d r = Eigen::Vector3d::Zero();
    Eigen::Matrix3d rr = Eigen::Matrix3d::Zero();
    Eigen::Vector3d rrr = Eigen::Vector3d::Zero();
    double rrrr = 0.0;

    // ∫ |r + t|² and ∫ |r + t|⁴.
    double Square(const Eigen::Vector3d& t) const {
      return rr.trace() + 2.0 * r.dot(t) + t.squaredNorm() * one;
    }
    // ∫ |r + t|² (r + t).
    Eigen::Vector3d Cube(const Eigen::Vector3d& t) const {
      return rrr + 2.0 * rr * t + t.squaredNorm() * r + Square(t) * t;
    }
    double Fourth(const Eigen::Vector3d& t) const {
      const double tt = t.squaredNorm();
      return rrrr + 4.0 * t.dot(rrr + rr * t) +
             tt * (2.0 * rr.trace() + 4.0 * r.dot(t) + tt * one);
    }
  };

  std::array<Of, 3> of_;
  double area_ = 0.0;
};

}  // namespace phongpd::internal
