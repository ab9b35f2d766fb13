// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/gap_lever.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Radius of a panel, in δ.
constexpr double kPanel = 1.0 / 3.0;

class LeverSum {
 public:
  LeverSum(const TriangleBvh& obstacle, const Vector3d& position, double delta)
      : obstacle_(obstacle), position_(position), delta_(delta) {}

  // Corners from the robot's origin, turned already.
  void Add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d middle = (a + b + c) / 3.0;
    const double radius = std::sqrt(
        std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(),
                  (c - middle).squaredNorm()}));
    const double gap = obstacle_.FindClosest(middle + position_).distance;
    if (gap >= delta_ + radius) return;  // none of its panels counts
    if (radius > kPanel * delta_) {
      const Vector3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      Add(a, ab, ca);
      Add(ab, b, bc);
      Add(ca, bc, c);
      Add(ab, bc, ca);
      return;
    }
    const double u = gap / delta_;
    if (!(u < 1.0)) return;
    const double square = (1.0 - u * u) * (1.0 - u * u);
    const double weight = square * square * (b - a).cross(c - a).norm();
    sum_ += weight * middle;
    weights_ += weight;
  }

  Vector3d Mean() const {
    return weights_ > 0.0 ? Vector3d(sum_ / weights_) : Vector3d::Zero();
  }

 private:
  const TriangleBvh& obstacle_;
  const Vector3d position_;
  const double delta_;
  Vector3d sum_ = Vector3d::Zero();
  double weights_ = 0.0;
};

}  // namespace

Vector3d GapLever(const TriangleMesh& robot, const TriangleBvh& obstacle,
                  const RobotPose& pose, double delta) {
  const Matrix3d rotation = pose.orientation.toRotationMatrix();
  LeverSum sum(obstacle, pose.position, delta);
  for (const Triangle& t : robot.triangles) {
    const auto corner = [&](int k) {
      return Vector3d(rotation * robot.vertices[static_cast<std::size_t>(
                                     t[static_cast<std::size_t>(k)])]);
    };
    sum.Add(corner(0), corner(1), corner(2));
  }
  return sum.Mean();
}

}  // namespace phongpd::internal
