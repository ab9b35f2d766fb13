// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/bvh/segment_triangle_meeting.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// Where segments meet a surface.  *Whether* they meet is exact, in the user's
// own coordinates, for segments and triangles in any position: in one plane,
// through an edge or a vertex, shorter than an ulp.  *Where* is rounded.
//
// A zero-area triangle is skipped: on a closed surface its points belong to
// its neighbours.  All queries require finite points, are thread-safe and do
// not allocate (but for coordinates beyond 1e±70, exact_sign.h).
class SegmentTree {
 public:
  struct Hit {
    int triangle = -1;      // −1: none
    double fraction = 1.0;  // of the way from a to b, in [0, 1]

    bool Found() const { return triangle >= 0; }
  };

  SegmentTree() = default;
  // Finite coordinates and valid indices.
  explicit SegmentTree(const TriangleMesh& mesh);

  // Exact: does the closed segment share a point with the surface?
  bool Meets(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const noexcept;

  // The first common point; found exactly when Meets.  Of several hits within
  // rounding of each other any may be returned.
  Hit FirstHit(const Eigen::Vector3d& a,
               const Eigen::Vector3d& b) const noexcept;

  // The same without the triangles closer to a than `radius` (≥ 0): for rays
  // that start on the surface, where every triangle that touches the rounded
  // start would be hit at once.
  Hit FirstHitBeyond(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                     double radius) const noexcept;

  // Distance between the closed segment and the surface if it is below
  // `limit` > 0, and `limit` otherwise; 0 exactly when they meet, elsewhere
  // rounded: a few ulps of the coordinates.  Zero-area triangles count by
  // their edges.
  double Distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  double limit) const noexcept;

  // Is that below `distance` ≥ 0?  True whenever they meet, exactly.
  bool ComesWithin(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                   double distance) const noexcept;

  // Calls visit(triangle, x) for every triangle with x ≤ `distance` ≥ 0, and
  // maybe for others; x is how far the segment is from the triangle's outline,
  // or one of its ends from the triangle.  These are all triangles whose
  // relation to the segment could change if points moved by as much.
  template <typename Visit>
  void ForEachDoubt(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                    double distance, const Visit& visit) const {
    const Reach reach(*this, a, b);
    tree_.ForEach(
        [&](int node) { return reach.Meets(tree_.nodes()[node], distance); },
        [&](int position) {
          visit(tree_.order()[position],
                OutlineDistance(corners_[position], a, b));
          return true;
        });
  }

  // Calls visit(triangle, fraction) for every triangle that shares a point
  // with the closed segment, in no particular order.
  template <typename Visit>
  void ForEachHit(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  const Visit& visit) const {
    const Reach reach(*this, a, b);
    tree_.ForEach([&](int node) { return reach.Meets(tree_.nodes()[node]); },
                  [&](int position) {
                    double fraction = 1.0;
                    if (MeetsTriangle(corners_[position], a, b, &fraction)) {
                      visit(tree_.order()[position], fraction);
                    }
                    return true;
                  });
  }

 private:
  using Corners = std::array<Eigen::Vector3d, 3>;

  // Conservative test of the segment against boxes.
  class Reach {
   public:
    Reach(const SegmentTree& tree, const Eigen::Vector3d& a,
          const Eigen::Vector3d& b);
    // Does the segment meet the box, widened by `margin`?
    bool Meets(const BoxTree::Node& node, double margin = 0.0) const;
    // Lower bound of the distance to a box.
    double Gap(const BoxTree::Node& node) const;
    // Lower bound of the fraction at which the segment enters a box it meets.
    double Entry(const BoxTree::Node& node) const;

   private:
    Eigen::Vector3d a_, min_, max_, half_, direction_, slack_;
  };

  static bool IsBeyond(const Corners& t, const Eigen::Vector3d& a,
                       const Eigen::Vector3d& b, double distance);
  // Distance of the segment to the triangle, were it not to pass through:
  // unlike ClosestPair it knows no crossings, and needs no points.
  static double OutlineDistance(const Corners& t, const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b);
  Hit First(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
            double radius) const noexcept;

  BoxTree tree_;
  std::vector<Corners> corners_;  // in the tree's order
  double largest_ = 0.0;          // of all absolute coordinates
};

}  // namespace phongpd
