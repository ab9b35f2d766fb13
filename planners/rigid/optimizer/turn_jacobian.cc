// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/turn_jacobian.h"

#include <Eigen/Geometry>
#include <cmath>

#include "planners/rigid/object_norm.h"

namespace phongpd::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Below it the series, whose next term is below rounding.
constexpr double kSmall = 1e-3;

Quaterniond TurnBy(const Vector3d& w) {
  const double angle = w.norm();
  if (!(angle > 0.0)) return Quaterniond::Identity();
  return Quaterniond(Eigen::AngleAxisd(angle, w / angle));
}

}  // namespace

Matrix3d CrossMatrix(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

// I + (1 − cos θ)/θ² [w] + (θ − sin θ)/θ³ [w]²
Matrix3d TurnJacobian(const Vector3d& w) {
  const double square = w.squaredNorm(), angle = std::sqrt(square);
  double first = 0.5 - square / 24.0, second = 1.0 / 6.0 - square / 120.0;
  if (angle > kSmall) {
    first = 2.0 * std::pow(std::sin(0.5 * angle) / angle, 2);
    second = (angle - std::sin(angle)) / (square * angle);
  }
  const Matrix3d cross = CrossMatrix(w);
  return Matrix3d::Identity() + first * cross + second * cross * cross;
}

// I − ½ [w] + (1/θ² − cot(θ/2)/(2θ)) [w]²
Matrix3d InverseTurnJacobian(const Vector3d& w) {
  const double square = w.squaredNorm(), angle = std::sqrt(square);
  const double second =
      angle > kSmall ? (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / square
                     : 1.0 / 12.0 + square / 720.0;
  const Matrix3d cross = CrossMatrix(w);
  return Matrix3d::Identity() - 0.5 * cross + second * cross * cross;
}

PoseBetween::PoseBetween(const RobotPose& a, const RobotPose& b, double t) {
  const Vector3d omega = TurnBetween(a.orientation, b.orientation);
  const Quaterniond turn = TurnBy(t * omega);
  pose.position = (1.0 - t) * a.position + t * b.position;
  pose.orientation = (turn * a.orientation).normalized();
  // δω = J⁻¹(ω) δ_b − J⁻¹(ω)ᵀ δ_a;  R(t) turns by t J(tω) δω + exp(t[ω]) δ_a.
  const Matrix3d inverse = InverseTurnJacobian(omega);
  const Matrix3d by_omega = t * TurnJacobian(t * omega);
  by_end = by_omega * inverse;
  by_start = turn.toRotationMatrix() - by_omega * inverse.transpose();
}

}  // namespace phongpd::internal
