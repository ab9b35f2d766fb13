// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// Where on the robot a wrench acts: the mean of its surface, weighted by how
// near the obstacle B is,
//
//   r̄ = Σ κ(g(x)/δ) a x / Σ κ(g(x)/δ) a,    κ(g) = (1 − g²)⁴ for g < 1, or 0
//
// over points x of ∂A of area a each, g(x) the distance of R x + q to B, 0
// inside.  A contact point jumps where an edge becomes parallel to a face; this
// is continuous in (q, R) wherever anything is within δ, as a quotient of sums
// of continuous functions, for the points there are: triangles of ∂A cut until
// no edge is longer than δ/2, so that one of them is within δ/3 where the
// robot touches.  r̄ lies in the hull of the robot.
class GapLever {
 public:
  // Closed meshes that bound solids; δ > 0, user's unit.  Throws InputError
  // where it takes more than 10⁶ points: δ is too small for the robot.
  GapLever(const TriangleMesh& robot, const TriangleMesh& obstacle,
           double reach);

  // r̄ in the robot's own frame, not turned and not moved; false, and *lever as
  // it was, where nothing is within δ.  Thread-safe, allocates nothing.
  bool At(const RobotPose& pose, Eigen::Vector3d* lever) const noexcept;

  double reach() const { return reach_; }
  std::size_t size() const { return points_.size(); }

 private:
  struct Point {
    Eigen::Vector3d x;
    double area;
  };
  void Cut(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
           const Eigen::Vector3d& c);

  std::vector<Point> points_;
  TriangleBvh obstacle_;
  BoundingBox bounds_;  // of the obstacle
  double reach_ = 0.0;
};

}  // namespace phongpd
