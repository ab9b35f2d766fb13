// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/bvh/triangle_bvh.h"
#include "core/bvh/triangle_corners.h"

namespace phongpd {

// A triangle, and the plane normal · x = level that separates it from a
// segment: no point of the triangle is above the plane, and every point of the
// segment is at least `distance` above it.
struct Separator {
  double distance = 0.0;  // rounded
  // Unit, from the triangle's closest point to the segment's; zero where they
  // meet.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double level = 0.0;
  TriangleCorners corners;
};

// Of one triangle and the segment a b; finite coordinates, in any unit.
Separator SeparatorOf(const TriangleCorners& corners, const Eigen::Vector3d& a,
                      const Eigen::Vector3d& b);

// A few planes that separate a segment from all triangles nearby.  Triangles
// are taken in the order of their distance; those behind the plane of an
// earlier one are left out, whole boxes of a tree at once.  The planes bound a
// convex region around the segment.
//
// Trees may be added while it runs, as they become known.
class SeparatorSearch {
 public:
  // Of the finite segment a b; of triangles within `radius` ≥ 0.  Behind a
  // plane is what is no more than `slack` ≥ 0 above it.
  SeparatorSearch(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  double radius, double slack);

  // May the box hold a triangle that is neither too far nor behind a plane?
  bool Needs(const BoxTree::Node& box) const;
  // Lower bound of the distance to what is in it.
  double Gap(const BoxTree::Node& box) const;

  // The tree must live until the search ends.
  void Add(const TriangleBvh& tree);
  // Takes all triangles nearer than `distance`; whatever is added afterwards
  // should be farther.
  void AdvanceTo(double distance);

  // So far, the nearest first.
  const std::vector<Separator>& found() const { return found_; }

 private:
  // What waits: a node of a tree, or a triangle.
  struct Waiting {
    double distance;  // at least
    int tree;
    int node;      // −1: a triangle
    int position;  // of that, in the tree
  };
  static bool IsLater(const Waiting& a, const Waiting& b);

  // Behind a plane found so far.
  bool IsHidden(const BoxTree::Node& box) const;
  bool IsHidden(const TriangleCorners& corners) const;
  void Take(const Separator& separator);
  void Offer(int tree, int node);
  void Push(const Waiting& item);
  void Open(const Waiting& item);

  Eigen::Vector3d a_, b_;
  double radius_, slack_;
  std::vector<const TriangleBvh*> trees_;
  std::vector<Waiting> queue_;  // a heap
  std::vector<Separator> found_;
  std::vector<double> levels_;  // of their planes, from a_: no digits are lost
                                // far from the origin
};

}  // namespace phongpd
