// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "constraints/rigid/quaternion_motion.h"
#include "constraints/rigid/rigid_motion.h"

// A motion as the judge sees it: in the frame of the meshes, with how fast it
// turns.  Both kinds turn about one axis u, by an angle φ(t) from the start:
// RigidMotion at a constant rate, φ = θ t; QuaternionMotion faster in the
// middle (quaternion_motion.h).
namespace phongpd::internal {

// Robot and obstacles are p·scale and (b − center)·scale there; the scale is a
// power of two.
struct RigidFrame {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1.0;
};

struct RigidPose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d position;
  Eigen::Vector3d turn;  // φ'(t) u
};

class FramedMotion {
 public:
  // `reach` of robot and of obstacles, in the frame.
  FramedMotion(const RigidMotion& motion, const RigidFrame& frame,
               double robot_reach, double obstacle_reach);
  FramedMotion(const QuaternionMotion& motion, const RigidFrame& frame,
               double robot_reach, double obstacle_reach);

  RigidPose At(double t) const;

  const Eigen::Vector3d& moved() const { return moved_; }          // Δq
  double distance() const { return distance_; }                    // |Δq|
  const Eigen::Vector3d& axis() const { return axis_; }            // u
  const Eigen::Vector3d& body_axis() const { return body_axis_; }  // R_aᵀ u
  // Over the whole way, rounded up: max φ' and max (φ'² + |φ''|).
  double rate() const { return rate_; }
  double bend() const { return bend_; }
  double slack() const { return slack_; }
  double size() const { return size_; }  // S

  // Of a point of the robot: ρ, rounded up.
  double FromAxis(const Eigen::Vector3d& p) const;
  // |n × u| of a direction, and of three by their n · u, rounded up.
  double AcrossAxis(const Eigen::Vector3d& n) const;
  Eigen::Vector3d Across(const Eigen::Array3d& along) const {
    return ((1.0 - along.square()).max(0.0) + kRoundedSquare).sqrt();
  }

 private:
  // Of a square of length 1 that products of rounded directions miss.
  static constexpr double kRoundedSquare = 0x1p-48;

  void SetSizes(const RigidFrame& frame, const Eigen::Vector3d& start,
                const Eigen::Vector3d& end, double reach);

  // Of a QuaternionMotion start_ and last_ are its a and b; of a RigidMotion
  // last_ is not used.
  bool is_quaternion_;
  Eigen::Quaterniond start_, last_;
  Eigen::Vector3d position_, moved_, axis_, turn_, body_axis_;
  double rate_, bend_, distance_, size_, slack_;
};

}  // namespace phongpd::internal
