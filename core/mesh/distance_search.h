// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "core/mesh/inside_test.h"
#include "core/mesh/solid_distance.h"
#include "core/mesh/surface_tree.h"
#include "core/mesh/triangle_mesh.h"

// The branch and bound behind solid_distance.h, in coordinates of the size
// of one.
namespace phongpd::internal {

// Distance to a surface, or to the solid it bounds.
class DistanceTarget {
 public:
  DistanceTarget(TriangleMesh mesh, bool is_solid);

  // The distance; of an inner point of the solid minus a lower bound of its
  // depth.  Tells the triangle closest to x.
  double At(const Eigen::Vector3d& x, int* closest) const;
  // Is x strictly inside the union of the components?
  bool Contains(const Eigen::Vector3d& x) const;
  // Distance to one triangle.
  double ToTriangle(int triangle, const Eigen::Vector3d& x) const;

 private:
  TriangleMesh mesh_;
  SurfaceTree tree_;
  std::vector<InsideTest> inside_;  // of each shell
  std::vector<int> sign_;           // of its volume
};

// A tetrahedron or a triangle, the convex hull of its corners.
struct Piece {
  std::array<Eigen::Vector3d, 4> corners = {
      Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
      Eigen::Vector3d::Zero()};
  int count = 4;
  double upper = std::numeric_limits<double>::infinity();

  bool operator<(const Piece& other) const { return upper < other.upper; }
};

// Bounds sup d(x, target) over the points x of the pieces that lie in the
// solid `domain`; null: all of them.
DistanceBounds FarthestPoint(std::vector<Piece> pieces,
                             const DistanceTarget& target,
                             const DistanceTarget* domain,
                             const DistanceSearch& search, double diagonal);

}  // namespace phongpd::internal
