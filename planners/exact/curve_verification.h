// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "constraints/motion_oracle.h"
#include "constraints/trajectory.h"
#include "planners/exact/verification.h"

namespace phongpd::internal {

// What Verifier knows, for its judgement of curves.
struct CurveGround {
  const MotionOracle* oracle = nullptr;  // none: no obstacle
  BoundingBox bounds;
  double rounding = 0.0;    // Verifier::rounding
  double least_step = 0.0;  // of it, what rounding to doubles takes
  // To some of the places within it that a robot in contact is tried at.
  const std::vector<Eigen::Vector3d>* directions = nullptr;
  // With which obstacle the robot collides at q.
  std::function<std::string(const Eigen::Vector3d& q)> name_obstacle;
};

// Verifier::VerifyCurve, of a curve that is not empty.  Parts of the curve are
// halved until intervals prove that the hull of each parts the surfaces of
// robot and obstacle, pair by pair of triangles (curve_hull.h), or that it
// does where it is moved by the rounding at most; whether one solid holds the
// other is asked exactly, once for all parts that follow each other unmoved.
Verification VerifyCurve(const CurveGround& ground, const Trajectory& curve);

}  // namespace phongpd::internal
