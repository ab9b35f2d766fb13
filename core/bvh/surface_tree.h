// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The point Σ λ_i q_i of a triangle closest to some x.
struct TrianglePoint {
  Eigen::Vector3d lambda = Eigen::Vector3d::Zero();  // ≥ 0, sums to 1
  double squared_distance = 0.0;
};

// Closest point of the triangle a, b, c, slivers and degenerate triangles
// included: the foot of the perpendicular where it falls into the triangle,
// and the three edges, compared by the distance actually reached.
TrianglePoint ClosestOnTriangle(const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b,
                                const Eigen::Vector3d& c,
                                const Eigen::Vector3d& x) noexcept;

// Closest points on a mesh.  Works in a frame of its own: centred on the
// bounding box and scaled by a power of two that brings the diagonal into
// [1, 2), so that results scale bit for bit with the input and neither offset
// nor unit costs digits.
class SurfaceTree {
 public:
  struct Closest {
    int triangle = -1;
    Eigen::Vector3d lambda = Eigen::Vector3d::Zero();
    double distance = 0.0;  // user's unit
  };

  SurfaceTree() = default;
  // At least one triangle, finite coordinates.
  explicit SurfaceTree(const TriangleMesh& mesh);

  // Exact up to rounding; of several closest triangles the one found first.
  // q must be finite; however far away it may be.
  Closest FindClosest(const Eigen::Vector3d& q) const noexcept;

  const Eigen::Vector3d& center() const { return center_; }
  double scale() const { return scale_; }

 private:
  using Corners = std::array<Eigen::Vector3d, 3>;

  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double scale_ = 1.0;
  BoxTree tree_;
  std::vector<Corners> corners_;  // in the tree's order
};

}  // namespace phongpd
