// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/diagnosis.h"

#include <cmath>
#include <cstddef>

#include "constraints/motion_oracle.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/world/depth_bound.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

std::string Called(const Vector3d& q, const std::string& which) {
  return which + " (" + FormatPoint(q) + ") is ";
}

// With three digits, and no less than `value` but for the rounding of double.
std::string RoundedUp(double value) {
  constexpr int kDigits = 3;
  constexpr double kRoundUp = 1e-12;
  const std::string nearest = Rounded(value, kDigits);
  if (ParseDouble(nearest, "depth") >= value * (1.0 - kRoundUp)) {
    return nearest;
  }
  const double step =
      std::pow(10.0, std::floor(std::log10(value)) - (kDigits - 1));
  return Rounded(std::ceil(value / step) * step, kDigits);
}

// Conservative: may the boxes of two solids meet, the first moved by q?
bool MayMeet(const BoundingBox& robot, const BoundingBox& obstacle,
             const Vector3d& q) {
  constexpr double kSlack = 1e-14;  // of the largest coordinate
  const auto largest = [](const BoundingBox& box) {
    return box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
  };
  const double slack =
      kSlack * (largest(robot) + largest(obstacle) + q.cwiseAbs().maxCoeff());
  return ((robot.min + q).array() <= obstacle.max.array() + slack).all() &&
         ((robot.max + q).array() >= obstacle.min.array() - slack).all();
}

std::string ExcessText(const Diagnosis::Excess& excess) {
  const std::string axis(1, "xyz"[excess.axis]);
  const std::string bound =
      std::string(excess.is_maximum ? "the maximum " : "the minimum ") +
      FormatDouble(excess.bound);
  if (excess.by == 0.0) return axis + " is on " + bound;
  return axis + " is " + Rounded(excess.by) +
         (excess.is_maximum ? " above " : " below ") + bound;
}

std::string ContactText(const Diagnosis::Contact& contact) {
  if (contact.depth_at_most == 0.0) return "touching " + contact.name;
  return "at most " + RoundedUp(contact.depth_at_most) + " deep in " +
         contact.name;
}

}  // namespace

std::string Diagnosis::Text(const std::string& which) const {
  if (IsFree()) return "";
  std::string text = Called(q, which);
  for (std::size_t i = 0; i < excesses.size(); ++i) {
    text += i == 0 ? "not strictly within the bounds: " : ", ";
    text += ExcessText(excesses[i]);
  }
  constexpr std::size_t kNamed = 5;
  for (std::size_t i = 0; i < contacts.size() && i < kNamed; ++i) {
    if (i > 0) text += ", ";
    if (i == 0 && !excesses.empty()) text += "; it is ";
    text += ContactText(contacts[i]);
  }
  if (contacts.size() > kNamed) {
    text += ", and meets " + std::to_string(contacts.size() - kNamed) +
            " more obstacles";
  }
  return text;
}

Diagnosis Diagnose(const Workspace& workspace, const Vector3d& q) {
  if (!q.allFinite()) {
    throw InputError("configuration: expected finite coordinates, found " +
                     FormatPoint(q));
  }
  Diagnosis diagnosis;
  diagnosis.q = q;
  const BoundingBox& bounds = workspace.bounds;
  for (int axis = 0; axis < 3 && !bounds.IsEmpty(); ++axis) {
    if (q[axis] <= bounds.min[axis]) {
      diagnosis.excesses.push_back(
          {axis, false, bounds.min[axis], bounds.min[axis] - q[axis]});
    }
    if (q[axis] >= bounds.max[axis]) {
      diagnosis.excesses.push_back(
          {axis, true, bounds.max[axis], q[axis] - bounds.max[axis]});
    }
  }
  const BoundingBox robot = ComputeBounds(workspace.robot);
  for (std::size_t i = 0; i < workspace.obstacles.size(); ++i) {
    const Solid& obstacle = workspace.obstacles[i];
    if (!MayMeet(robot, ComputeBounds(obstacle), q)) continue;
    const MotionOracle oracle(workspace.robot, obstacle);
    if (!oracle.Collides(q)) continue;
    const WayOut way = BoundDepth(workspace.robot, obstacle, q, oracle);
    diagnosis.contacts.push_back(
        {static_cast<int>(i), obstacle.name(), way.length, way.direction});
  }
  return diagnosis;
}

std::string BlockedByRounding(const Vector3d& q, const std::string& which) {
  return Called(q, which) +
         "free of the solids, but nearer to contact than their contact space "
         "is rounded; move it away from them";
}

}  // namespace phongpd
