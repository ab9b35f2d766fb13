// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_motion.h"

#include <Eigen/LU>
#include <cmath>
#include <string>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kOrthogonalTo = 1e-9;
// Of a quaternion's scalar part: half an angle from half a turn.
constexpr double kHalfTurnScalar = 0.5e-12;
constexpr double kSameAxis = 1e-6;

// exp([v]).
Quaterniond TurnBy(const Vector3d& axis, double angle) {
  Quaterniond q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = std::sin(0.5 * angle) * axis;
  return q;
}

// The vector of the rotation, of length ≤ π.
Vector3d TurnOf(const Quaterniond& rotation) {
  Vector3d v = rotation.vec();
  double w = rotation.w();
  const double s = v.norm();
  if (!(s > 0.0)) return Vector3d::Zero();
  bool turns_over = w < 0.0;
  if (std::abs(w) <= kHalfTurnScalar) {
    int first = 0;
    while (std::abs(v[first]) <= kSameAxis) ++first;
    turns_over = v[first] < 0.0;
  }
  if (turns_over) {
    v = -v;
    w = -w;
  }
  return v * (2.0 * std::atan2(s, w) / s);
}

}  // namespace

RigidMotion::RigidMotion(const RobotPose& start, const RobotPose& end)
    : start_(start), end_(end) {
  CheckPose(start, "rigid motion: start");
  CheckPose(end, "rigid motion: end");
  const Quaterniond a = start.orientation.normalized();
  const Quaterniond b = end.orientation.normalized();
  // The same orientation, or its negative, turns by nothing at all.
  const bool is_same = a.coeffs() == b.coeffs() || a.coeffs() == -b.coeffs();
  SetTurn(is_same ? Vector3d::Zero() : TurnOf(b * a.conjugate()));
}

RigidMotion::RigidMotion(const Eigen::Isometry3d& start,
                         const Eigen::Isometry3d& end)
    : RigidMotion(PoseOf(start, "rigid motion: start"),
                  PoseOf(end, "rigid motion: end")) {}

RigidMotion RigidMotion::Turning(const RobotPose& start,
                                 const Vector3d& end_position,
                                 const Vector3d& turn) {
  CheckPose(start, "rigid motion: start");
  if (!IsFinite(end_position) || !IsFinite(turn)) {
    throw InputError(
        "rigid motion: expected a finite end and turn, found NaN or infinity");
  }
  if (!(turn.norm() <= kMaxTurn)) {
    throw InputError("rigid motion: expected a turn of at most " +
                     Rounded(kMaxTurn) + " rad, found " +
                     Rounded(turn.stableNorm()) + "; leave out whole turns");
  }
  RigidMotion motion;
  motion.start_ = start;
  motion.SetTurn(turn);
  motion.end_.position = end_position;
  motion.end_.orientation =
      (TurnBy(motion.axis_, motion.angle_) * start.orientation).normalized();
  return motion;
}

void RigidMotion::SetTurn(const Vector3d& turn) {
  turn_ = turn;
  angle_ = turn.stableNorm();
  if (angle_ > 0.0) axis_ = (turn / angle_).stableNormalized();
}

RobotPose RigidMotion::At(double t) const {
  RobotPose pose;
  pose.position = (1.0 - t) * start_.position + t * end_.position;
  pose.orientation =
      angle_ > 0.0
          ? (TurnBy(axis_, t * angle_) * start_.orientation).normalized()
          : start_.orientation;
  return pose;
}

RobotPose PoseOf(const Eigen::Isometry3d& matrix, const std::string& what) {
  const Eigen::Matrix3d rotation = matrix.linear();
  bool is_finite = IsFinite(matrix.translation());
  for (int k = 0; k < 3; ++k)
    is_finite = is_finite && IsFinite(rotation.col(k));
  if (!is_finite) {
    throw InputError(what + ": expected a finite pose, found NaN or infinity");
  }
  const double off =
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity())
          .cwiseAbs()
          .maxCoeff();
  if (!(off <= kOrthogonalTo)) {
    throw InputError(what + ": expected a rotation, RᵀR = 1 to 1e-9, found " +
                     Rounded(off) + " off; leave out scale and shear");
  }
  if (!(rotation.determinant() > 0.0)) {
    throw InputError(what +
                     ": expected a rotation, found a reflection, of "
                     "determinant -1; change the sign of an axis");
  }
  RobotPose pose;
  pose.position = matrix.translation();
  pose.orientation = Quaterniond(rotation).normalized();
  return pose;
}

}  // namespace phongpd
