// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/trajectory.h"

namespace phongpd::internal {

// A curve of pieces of degree 5 by what it is at their ends: of class C²
// whatever the numbers are.  Piece i, of duration h from state (p₀, v₀, a₀) to
// (p₁, v₁, a₁), has the Bézier points
//
//   B₀ = p₀   B₁ = p₀ + h v₀/5   B₂ = p₀ + 2h v₀/5 + h² a₀/20
//   B₅ = p₁   B₄ = p₁ − h v₁/5   B₃ = p₁ − 2h v₁/5 + h² a₁/20.
struct KnotCurve {
  struct State {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    Eigen::Vector3d a = Eigen::Vector3d::Zero();
  };
  using Points = Eigen::Matrix<double, 3, 6>;

  std::vector<State> knots;       // one more than pieces
  std::vector<double> durations;  // > 0

  int pieces() const { return static_cast<int>(durations.size()); }
  double Duration() const;
  Points PointsOf(int piece) const;
  Trajectory ToTrajectory() const;

  // The same way `factor` times as slowly.
  void Slow(double factor);
  // Each piece in two: the same curve but for rounding.
  KnotCurve Halved() const;
};

// Bézier points of the derivatives of a piece by time.
struct PieceDerivatives {
  PieceDerivatives(const KnotCurve::Points& points, double duration);
  Eigen::Matrix<double, 3, 5> velocity;
  Eigen::Matrix<double, 3, 4> acceleration;
  Eigen::Matrix<double, 3, 3> jerk;
};

// The least factor by which the points of all derivatives keep the limits; and
// of each piece by itself.
double SlowingOf(const KnotCurve& curve, const MotionLimits& limits);
std::vector<double> SlowingOfPieces(const KnotCurve& curve,
                                    const MotionLimits& limits);

// From corner to corner in straight lines, the exact judge agreeing: first the
// farthest that is in sight.  Each line is as far from contact as the way that
// it replaces, or as `clearance` and 1e-12 of the largest coordinate, by which
// rounding may take a curve off it.  Requires a free path; equal points that
// follow each other are one.
std::vector<Eigen::Vector3d> DropCorners(
    const FreeSpace& space, const std::vector<Eigen::Vector3d>& path,
    double clearance);

// Along the path's segments, each from rest to rest as 10s³ − 15s⁴ + 6s⁵, in
// the least time at which the points of its `pieces` equally long pieces keep
// the limits.  Requires two points at least, those next to each other
// different.
KnotCurve StopAtCorners(const std::vector<Eigen::Vector3d>& path,
                        const MotionLimits& limits, int pieces);

}  // namespace phongpd::internal
