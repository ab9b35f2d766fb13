// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/gap_lever.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostPoints = 1'000'000;

}  // namespace

GapLever::GapLever(const TriangleMesh& robot, const TriangleMesh& obstacle,
                   double reach)
    : obstacle_(obstacle), bounds_(ComputeBounds(obstacle)), reach_(reach) {
  if (!(reach > 0.0) || !std::isfinite(reach)) {
    throw InputError("GapLever: expected a finite reach above 0, found " +
                     FormatDouble(reach));
  }
  for (const Triangle& t : robot.triangles) {
    const auto corner = [&](std::size_t k) {
      return robot.vertices[static_cast<std::size_t>(t[k])];
    };
    Cut(corner(0), corner(1), corner(2));
  }
}

// At the middle of the longest edge, so that slivers become shorter first.
void GapLever::Cut(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
  if (bc > ab && bc >= ca) return Cut(b, c, a);
  if (ca > ab && ca > bc) return Cut(c, a, b);
  if (ab > 0.5 * reach_) {
    const Vector3d middle = 0.5 * (a + b);
    Cut(a, middle, c);
    Cut(middle, b, c);
    return;
  }
  if (points_.size() == kMostPoints) {
    throw InputError("GapLever: expected a reach for at most " +
                     std::to_string(kMostPoints) + " points, found " +
                     FormatDouble(reach_) +
                     "; take a larger one, or a smaller robot");
  }
  points_.push_back({(a + b + c) / 3.0, 0.5 * (b - a).cross(c - a).norm()});
}

bool GapLever::At(const RobotPose& pose, Vector3d* lever) const noexcept {
  const Eigen::Matrix3d turn = pose.orientation.toRotationMatrix();
  Vector3d sum = Vector3d::Zero();
  double weights = 0.0;
  for (const Point& point : points_) {
    const Vector3d x = turn * point.x + pose.position;
    // Cheaper than the tree: most points are away from it.
    const Vector3d outside =
        (bounds_.min - x).cwiseMax(x - bounds_.max).cwiseMax(0.0);
    if (outside.squaredNorm() >= reach_ * reach_) continue;
    const double g = obstacle_.FindClosest(x).distance / reach_;
    const bool is_within =
        outside == Vector3d::Zero() && obstacle_.WindingNumber(x) > 0;
    if (!is_within && g >= 1.0) continue;
    const double w = is_within ? 1.0 : std::pow(1.0 - g * g, 4.0);
    weights += w * point.area;
    sum += w * point.area * point.x;
  }
  if (!(weights > 0.0)) return false;
  *lever = sum / weights;
  return true;
}

}  // namespace phongpd
