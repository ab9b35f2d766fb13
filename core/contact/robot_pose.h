// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

namespace phongpd {

// Where the robot A is put: every vertex a becomes R·a + q, with R the matrix
// of the quaternion.
struct RobotPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // q, user's unit
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // of unit
                                                                    // length
};

// Throws InputError "<what>: …" unless the pose is finite and its quaternion of
// unit length to 1e-9.
void CheckPose(const RobotPose& pose, const std::string& what);

}  // namespace phongpd
