// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/quaternion_motion.h"

namespace phongpd {

QuaternionMotion QuaternionMotion::Between(const RobotPose& start,
                                           const RobotPose& end) {
  CheckPose(start, "quaternion motion: start");
  CheckPose(end, "quaternion motion: end");
  QuaternionMotion motion;
  motion.start_ = start;
  motion.end_ = end;
  // As rounded: the sign is a choice, and either one is a motion.
  Eigen::Quaterniond& b = motion.end_.orientation;
  if (start.orientation.dot(b) < 0.0) b.coeffs() = -b.coeffs();
  return motion;
}

RobotPose QuaternionMotion::At(double t) const {
  RobotPose pose;
  pose.position = (1.0 - t) * start_.position + t * end_.position;
  pose.orientation.coeffs() =
      (1.0 - t) * start_.orientation.coeffs() + t * end_.orientation.coeffs();
  pose.orientation.normalize();
  return pose;
}

}  // namespace phongpd
