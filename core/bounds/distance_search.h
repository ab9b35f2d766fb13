// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "core/bounds/solid_distance.h"
#include "core/bvh/box_tree.h"
#include "core/bvh/triangle_bvh.h"
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
  // The corners of a triangle.
  std::array<Eigen::Vector3d, 3> Corners(int triangle) const;
  // Is there a direction n with n·N > 0 for the normal N of every facet that
  // meets the ball?  Degenerate facets count as a no.
  bool FacesOneWay(const Eigen::Vector3d& center, double radius) const;

 private:
  TriangleMesh mesh_;
  std::vector<Eigen::Vector3d> normals_;  // unit; zero: degenerate
  TriangleBvh tree_;
  BoxTree boxes_;
  std::vector<TriangleBvh> inside_;  // of each shell
  std::vector<int> sign_;            // of its volume
};

// A tetrahedron or a triangle, the convex hull of its corners.
struct Piece {
  std::array<Eigen::Vector3d, 4> corners = {
      Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
      Eigen::Vector3d::Zero()};
  int count = 4;
  // Of the distances of its points; of a tetrahedron, of those points only
  // where the distance can have a local maximum.
  double upper = std::numeric_limits<double>::infinity();
  // Where to cut it: through edge (cut_a, cut_b) at fraction cut_at.
  int cut_a = 0, cut_b = 1;
  double cut_at = 0.5;
  bool was_cut_in_half = true;  // it came from the longest edge of its parent

  bool operator<(const Piece& other) const { return upper < other.upper; }
};

// Triangles: bounds sup d(x, target) over their points.  Tetrahedra: over
// those points in the solid `domain` where d(·, target) has a local maximum.
// `reached` is a distance known to be reached already.
DistanceBounds FarthestPoint(std::vector<Piece> pieces,
                             const DistanceTarget& target,
                             const DistanceTarget* domain,
                             const DistanceSearch& search, double diagonal,
                             double reached);

}  // namespace phongpd::internal
