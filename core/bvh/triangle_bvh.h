// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/bvh/closest_on_triangle.h"
#include "core/bvh/segment_reach.h"
#include "core/bvh/segment_triangle_intersection.h"
#include "core/bvh/triangle_corners.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

enum class Location { kOutside, kOnSurface, kInside };

// The triangles of a mesh in one box tree, for every question about points and
// segments: what is closest, where segments meet the surface, what is inside.
//
// *Whether* is exact, in the user's own coordinates and in any position: in
// one plane, through an edge or a vertex, shorter than an ulp.  *Where* and
// *how far* are rounded.  Distances are computed in a frame of their own,
// x' = (x − centre)·scale with scale the power of two that brings the
// diagonal into [1, 2): they scale bit for bit with the input, and neither
// offset nor unit costs digits.
//
// All queries are thread-safe and do not allocate (but for exact signs of
// coordinates beyond 1e±70, exact_sign.h).
class TriangleBvh {
 public:
  struct Closest {
    int triangle = -1;
    Eigen::Vector3d lambda = Eigen::Vector3d::Zero();
    double distance = 0.0;  // user's unit
  };
  struct Hit {
    int triangle = -1;      // −1: none
    double fraction = 1.0;  // of the way from a to b, in [0, 1]

    bool Found() const { return triangle >= 0; }
  };

  TriangleBvh() = default;
  // Valid indices, finite coordinates; triangles without area are harmless.
  explicit TriangleBvh(const TriangleMesh& mesh);

  // The point of the surface closest to a finite q, however far away; at least
  // one triangle.  Of several closest triangles the one found first.
  Closest FindClosest(const Eigen::Vector3d& q) const noexcept;

  // Where q lies relative to the solid that a closed mesh bounds; kOutside for
  // a q that is not finite.  Parity of the crossings of a vertical ray from q,
  // ties removed by symbolic perturbation: the ray starts at (x + ε, y + ε²,
  // z), so it never meets an edge or a vertex, and vertical triangles never
  // count.  The surface itself is found without it, by the exact signs.
  Location Locate(const Eigen::Vector3d& q) const;
  // How often a closed, oriented surface winds around q, found as above: with
  // shells that face outwards and cavities that face into them, more than 0
  // inside also where components overlap.  0 on the surface, outside, and for q
  // that is not finite.
  int WindingNumber(const Eigen::Vector3d& q) const;

  // Segments a b: finite points.  A triangle without area is skipped: on a
  // closed surface its points belong to its neighbours.

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
  // rounded: a few ulps of the coordinates.  Triangles without area count by
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
    const internal::SegmentReach reach(a, b, largest_);
    tree_.ForEach(
        [&](int node) { return reach.Meets(tree_.nodes()[node], distance); },
        [&](int position) {
          visit(tree_.order()[position],
                internal::OutlineDistance(corners_[position], a, b));
          return true;
        });
  }

  // Calls visit(triangle, fraction) for every triangle that shares a point
  // with the closed segment, in no particular order.
  template <typename Visit>
  void ForEachHit(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  const Visit& visit) const {
    const internal::SegmentReach reach(a, b, largest_);
    tree_.ForEach([&](int node) { return reach.Meets(tree_.nodes()[node]); },
                  [&](int position) {
                    double fraction = 1.0;
                    if (MeetsTriangle(corners_[position], a, b, &fraction)) {
                      visit(tree_.order()[position], fraction);
                    }
                    return true;
                  });
  }

  // For searches of one's own.  In the tree's order, user's coordinates:
  const BoxTree& tree() const { return tree_; }
  const std::vector<TriangleCorners>& corners() const { return corners_; }
  // And in the frame of distances.
  const Eigen::Vector3d& center() const { return center_; }
  double scale() const { return scale_; }
  Eigen::Vector3d ToFrame(const Eigen::Vector3d& x) const {
    return (x - center_) * scale_;
  }
  // Rounding is monotone: this is the box of the corners' own ToFrame.
  BoxTree::Node ToFrame(const BoxTree::Node& node) const {
    return {ToFrame(node.min), ToFrame(node.max), node.first, node.count};
  }
  TriangleCorners ToFrame(const TriangleCorners& t) const {
    return {ToFrame(t[0]), ToFrame(t[1]), ToFrame(t[2])};
  }

  // Trees built by this process so far: what a test of sharing counts.
  static long CountBuilt();

 private:
  struct Winding {
    int number = 0;
    bool on_surface = false;
  };
  Winding FindWinding(const Eigen::Vector3d& q) const;
  Hit First(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
            double radius) const noexcept;

  BoxTree tree_;
  std::vector<TriangleCorners> corners_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double scale_ = 1.0;
  double largest_ = 0.0;  // of all absolute coordinates
};

}  // namespace phongpd
