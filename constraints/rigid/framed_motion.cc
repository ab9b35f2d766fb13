// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/framed_motion.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kRigidSlack = 0x1p-44;
// More than rounding takes off a bound of the rate of turning.
constexpr double kRoundedUp = 1.0 + 0x1p-40;

}  // namespace

FramedMotion::FramedMotion(const RigidMotion& motion, const RigidFrame& frame,
                           double robot_reach, double obstacle_reach)
    : is_quaternion_(false),
      start_(motion.start().orientation.normalized()),
      last_(start_),
      axis_(motion.axis()),
      turn_(motion.turn()),
      rate_(motion.angle()),
      bend_(motion.angle() * motion.angle()) {
  SetSizes(frame, motion.start().position, motion.end().position,
           robot_reach + obstacle_reach);
}

// With s = |a||b| sin Ω, the length of the vector of b ā where a·b ≥ 0, and
// N = |p|²: φ' = 2 s / N and φ'' = −2 s N' / N².  N is convex in t, so that
// |N'| is most at an end, 2 |a·(b − a)| or 2 |b·(b − a)|, and N least at a
// fourth of |a + b|² or more: the line from a to b is nearest to 0 between them
// at less only by |a| ≠ |b|, which are 1 to 1e-9.
FramedMotion::FramedMotion(const QuaternionMotion& motion,
                           const RigidFrame& frame, double robot_reach,
                           double obstacle_reach)
    : is_quaternion_(true),
      start_(motion.start().orientation),
      last_(motion.end().orientation) {
  constexpr double kUnequal = 1.0 + 1e-7;
  const Eigen::Vector4d a = start_.coeffs(), b = last_.coeffs();
  turn_ = (last_ * start_.conjugate()).vec();
  const double s = turn_.norm();
  axis_ = s > 0.0 ? Vector3d(turn_ / s) : Vector3d::UnitX();
  const double least = 0.25 * (a + b).squaredNorm() / kUnequal;
  const double slope =
      2.0 * std::max(std::abs(a.dot(b - a)), std::abs(b.dot(b - a)));
  rate_ = 2.0 * s / least * kRoundedUp;
  bend_ = (rate_ * rate_ + 2.0 * s * slope / (least * least)) * kRoundedUp;
  SetSizes(frame, motion.start().position, motion.end().position,
           robot_reach + obstacle_reach);
}

void FramedMotion::SetSizes(const RigidFrame& frame, const Vector3d& start,
                            const Vector3d& end, double reach) {
  position_ = (start - frame.center) * frame.scale;
  moved_ = (end - start) * frame.scale;
  distance_ = moved_.norm();
  body_axis_ = start_.conjugate().normalized() * axis_;
  const Vector3d last = (end - frame.center) * frame.scale;
  size_ = reach + std::max(position_.norm(), last.norm());
  const double turns = std::max(rate_, std::sqrt(bend_));
  slack_ = kRigidSlack * size_ * (1.0 + turns) * (1.0 + turns);
}

RigidPose FramedMotion::At(double t) const {
  RigidPose pose;
  pose.position = position_ + t * moved_;
  pose.turn = turn_;
  if (is_quaternion_) {
    Quaterniond p;
    p.coeffs() = (1.0 - t) * start_.coeffs() + t * last_.coeffs();
    pose.turn *= 2.0 / p.squaredNorm();
    pose.rotation = p.normalized().toRotationMatrix();
    return pose;
  }
  if (rate_ == 0.0) {
    pose.rotation = start_.toRotationMatrix();
    return pose;
  }
  const double half = 0.5 * (t * rate_);
  Quaterniond turned;
  turned.w() = std::cos(half);
  turned.vec() = std::sin(half) * axis_;
  pose.rotation = (turned * start_).toRotationMatrix();
  return pose;
}

double FramedMotion::FromAxis(const Vector3d& p) const {
  const double along = p.dot(body_axis_), squared = p.squaredNorm();
  return std::sqrt(std::max(0.0, squared - along * along) +
                   kRoundedSquare * squared);
}

double FramedMotion::AcrossAxis(const Vector3d& n) const {
  const double along = n.dot(axis_);
  return std::sqrt(std::max(0.0, 1.0 - along * along) + kRoundedSquare);
}

}  // namespace phongpd::internal
