// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/pose_chart.h"

#include "planners/rigid/optimizer/turn_jacobian.h"

namespace phongpd::internal {

using Eigen::Vector3d;

Vector3d PoseChart::TurnOf(int i, const double* x) const {
  return unit_ / gyration_ * Eigen::Map<const Vector3d>(x + 6 * (i - 1) + 3);
}

std::vector<RobotPose> PoseChart::Poses(const double* x) const {
  std::vector<RobotPose> poses = around_;
  for (int i = 1; i <= knots(); ++i) {
    RobotPose& pose = poses[static_cast<std::size_t>(i)];
    pose = Moved(pose, unit_ * Eigen::Map<const Vector6>(x + 6 * (i - 1)),
                 gyration_);
  }
  return poses;
}

Vector6 PoseChart::ByNumbers(int i, const double* x,
                             const Vector6& by_pose) const {
  Vector6 numbers;
  numbers << unit_ * by_pose.head<3>(),
      unit_ / gyration_ *
          (TurnJacobian(TurnOf(i, x)).transpose() * by_pose.tail<3>());
  return numbers;
}

double PoseChart::Energy(const double* x) const {
  const std::vector<RobotPose> poses = Poses(x);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    sum +=
        (Difference(poses[i], poses[i + 1], gyration_) / unit_).squaredNorm();
  }
  return sum;
}

// ω is its own image under the Jacobians: a turn of the end moves |ω|² by
// 2 ω · δ_b, one of the start by −2 ω · δ_a.
void PoseChart::EnergyGradient(const double* x, double* gradient) const {
  const std::vector<RobotPose> poses = Poses(x);
  const auto slope = [&](int link) {
    const auto i = static_cast<std::size_t>(link);
    Vector6 by_end =
        2.0 / (unit_ * unit_) * Difference(poses[i], poses[i + 1], gyration_);
    by_end.tail<3>() *= gyration_;
    return by_end;
  };
  for (int i = 1; i <= knots(); ++i) {
    Eigen::Map<Vector6>(gradient + 6 * (i - 1)) =
        ByNumbers(i, x, slope(i - 1) - slope(i));
  }
}

}  // namespace phongpd::internal
