// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/joint_turns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/pi.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr int kPieces = 20;

struct Ends {
  Vector3d start, goal;
};

Ends EndsOf(const JointRobot& robot) {
  return {robot.motion.At(0.0).position, robot.motion.pieces().back().back()};
}

Vector3d Up(const std::vector<JointRobot>& robots) {
  Eigen::AlignedBox3d box;
  for (const JointRobot& robot : robots) {
    const Ends ends = EndsOf(robot);
    box.extend(ends.start);
    box.extend(ends.goal);
  }
  Eigen::Index axis = 0;
  box.sizes().minCoeff(&axis);
  return Vector3d::Unit(axis);
}

KnotCurve Turned(const Ends& ends, const Vector3d& up, double lane) {
  const Vector3d e = 0.5 * (ends.goal - ends.start);
  const Vector3d middle = 0.5 * (ends.goal + ends.start);
  const Vector3d across = e.cross(up);
  const Vector3d wide = across.isZero(0.0)
                            ? Vector3d(Vector3d::Zero())
                            : Vector3d(lane / across.norm() * across);
  KnotCurve curve;
  for (int k = 0; k <= kPieces; ++k) {
    const double s = static_cast<double>(k) / kPieces, u = 1.0 - s;
    const double angle = kPi * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    const double speed = kPi * 30.0 * s * s * u * u;
    const double faster = kPi * 60.0 * s * u * (u - s);
    const double c = std::cos(angle), i = std::sin(angle);
    const Vector3d along = e * i + wide * c;
    curve.knots.push_back(
        {middle - e * c + wide * i, speed * along,
         faster * along + speed * speed * (e * c - wide * i)});
  }
  curve.knots.front() = {ends.start, Vector3d::Zero(), Vector3d::Zero()};
  curve.knots.back() = {ends.goal, Vector3d::Zero(), Vector3d::Zero()};
  curve.durations.assign(kPieces, 1.0 / kPieces);
  return curve;
}

}  // namespace

std::vector<Trajectory> TurnedMotions(const std::vector<JointRobot>& robots,
                                      double lane) {
  const Vector3d up = Up(robots);
  std::vector<KnotCurve> curves;
  double slowing = 0.0;
  for (const JointRobot& robot : robots) {
    curves.push_back(Turned(EndsOf(robot), up, lane));
    slowing = std::max(slowing, SlowingOf(curves.back(), robot.limits));
  }
  std::vector<Trajectory> motions;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    curves[i].Slow(slowing);
    motions.push_back(robots[i].stays ? robots[i].motion
                                      : curves[i].ToTrajectory());
  }
  return motions;
}

}  // namespace phongpd::internal
