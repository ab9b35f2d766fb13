// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/contact/robot_pose.h"
#include "planners/rigid/object_norm.h"

namespace phongpd::internal {

// The poses of a path as variables of a program.  Its ends are fixed; of the
// knots between them each has six numbers around where it was, (p̂, R̂),
//
//   p = p̂ + U x₁…₃,    R = exp([w]) R̂,   w = (U/L) x₄…₆,
//
// U a length of the order of the robot, L its radius of gyration: so |x| is a
// displacement in the object norm over U, to first order.  Good for |w| below
// a turn or so; further on a chart around the new poses takes its place.
class PoseChart {
 public:
  // Three poses or more.
  PoseChart(std::vector<RobotPose> around, double unit, double gyration)
      : around_(std::move(around)), unit_(unit), gyration_(gyration) {}

  int knots() const { return static_cast<int>(around_.size()) - 2; }
  int links() const { return knots() + 1; }
  int variables() const { return 6 * knots(); }
  double unit() const { return unit_; }
  double gyration() const { return gyration_; }
  const std::vector<RobotPose>& around() const { return around_; }

  // All poses, both ends bit for bit.
  std::vector<RobotPose> Poses(const double* x) const;

  // Of knot i ≥ 1 of `around`: from (∂/∂p, ∂/∂δ) of a function of its pose to
  // the derivatives by its six numbers.
  Vector6 ByNumbers(int i, const double* x, const Vector6& by_pose) const;

  // Σ d²/U² over the links, d the object norm, and its gradient.
  double Energy(const double* x) const;
  void EnergyGradient(const double* x, double* gradient) const;

 private:
  Eigen::Vector3d TurnOf(int i, const double* x) const;  // w

  std::vector<RobotPose> around_;
  double unit_, gyration_;
};

}  // namespace phongpd::internal
