// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/object_norm.h"

#include <cmath>

namespace phongpd::internal {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d TurnBetween(const Quaterniond& a, const Quaterniond& b) {
  if (a.coeffs() == b.coeffs()) return Vector3d::Zero();
  const Quaterniond turn = b * a.conjugate();
  const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
  const double s = turn.vec().norm();
  if (!(s > 0.0)) return Vector3d::Zero();
  return sign * 2.0 * std::atan2(s, std::abs(turn.w())) / s * turn.vec();
}

RobotPose Moved(const RobotPose& pose, const Vector6& move, double gyration) {
  RobotPose moved = pose;
  moved.position += move.head<3>();
  const Vector3d omega = move.tail<3>() / gyration;
  const double angle = omega.norm();
  if (angle > 0.0) {
    const Quaterniond turn(Eigen::AngleAxisd(angle, omega / angle));
    moved.orientation = (turn * pose.orientation).normalized();
  }
  return moved;
}

Vector6 Difference(const RobotPose& a, const RobotPose& b, double gyration) {
  Vector6 difference;
  difference << b.position - a.position,
      gyration * TurnBetween(a.orientation, b.orientation);
  return difference;
}

double ObjectDistance(const RobotPose& a, const RobotPose& b, double gyration) {
  return Difference(a, b, gyration).norm();
}

}  // namespace phongpd::internal
