// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/self_intersection.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Object.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/bvh/box_tree.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// Of what is constructed with it nearly all has to be known exactly: intervals
// that come first would only take time, and most of the compiler's.
using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using Point = Kernel::Point_3;
using CornerPoints = std::array<Point, 3>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

// Leaves of four triangles that one task compares: a small mesh wakes no
// thread.
constexpr std::size_t kLeavesOfTask = 16;

CornerPoints CornersOf(const TriangleMesh& mesh, const Triangle& triangle) {
  const auto point = [&mesh](int v) {
    const Vector3d& p = mesh.vertices[v];
    return Point(p.x(), p.y(), p.z());
  };
  return {point(triangle[0]), point(triangle[1]), point(triangle[2])};
}

Kernel::Triangle_3 ToTriangle(const CornerPoints& c) {
  return {c[0], c[1], c[2]};
}

// A triangle in double, and where points surely lie beside it: most pairs of
// neighbours are decided by that.
class RoundedTriangle {
 public:
  RoundedTriangle(const TriangleMesh& mesh, const Triangle& t)
      : corners_{mesh.vertices[t[0]], mesh.vertices[t[1]],
                 mesh.vertices[t[2]]} {
    const Vector3d u = corners_[1] - corners_[0];
    const Vector3d v = corners_[2] - corners_[0];
    normal_ = u.cross(v);
    reach_ = u.cwiseAbs().cwiseMax(v.cwiseAbs());
    normal_.cwiseAbs().maxCoeff(&axis_);
    turn_ = Turn(corners_[0], corners_[1], corners_[2]);
  }

  // Do the two surely share common corners at most, or a common edge?
  bool IsBeside(const RoundedTriangle& other) const {
    return IsOnOneSide(other) || IsBehindAnEdge(other);
  }

 private:
  bool IsCorner(const Vector3d& p) const {
    return p == corners_[0] || p == corners_[1] || p == corners_[2];
  }

  // Do all corners of `other` that are none of this one's surely lie on one
  // side of its plane?
  bool IsOnOneSide(const RoundedTriangle& other) const {
    int side = 0;
    for (const Vector3d& p : other.corners_) {
      if (IsCorner(p)) continue;
      const int at = Side(p);
      if (at == 0 || at == -side) return false;
      side = at;
    }
    return side != 0;
  }

  // Seen along the axis that the normal is nearest to: does a line through one
  // edge part the two, but for ends of the edge that are common?  So it is with
  // neighbours in one plane.
  bool IsBehindAnEdge(const RoundedTriangle& other) const {
    if (turn_ == 0) return false;
    for (int k = 0; k < 3; ++k) {
      const Vector3d& a = corners_[k];
      const Vector3d& b = corners_[(k + 1) % 3];
      const auto is_behind = [&](const Vector3d& p) {
        return p == a || p == b || Turn(a, b, p) == -turn_;
      };
      if (std::all_of(other.corners_.begin(), other.corners_.end(),
                      is_behind)) {
        return true;
      }
    }
    return false;
  }

  // Of the plane; 0 where rounding might decide it.  The determinant has six
  // products of one coordinate difference along each axis, and at most eight
  // roundings reach any of them: 6 · 8 · 2^-53 of the product of the largest.
  int Side(const Vector3d& p) const {
    const Vector3d d = p - corners_[0];
    const Vector3d m = d.cwiseAbs().cwiseMax(reach_);
    // No product leaves the range of doubles.
    if (!(m.minCoeff() > 1e-90 && m.maxCoeff() < 1e90)) return 0;
    const double bound = 1e-14 * m[0] * m[1] * m[2];
    const double height = normal_.dot(d);
    return height > bound ? 1 : height < -bound ? -1 : 0;
  }

  // Of a, b, p as seen along the axis; 0 where rounding might decide it: three
  // roundings reach either product, and one their difference.
  int Turn(const Vector3d& a, const Vector3d& b, const Vector3d& p) const {
    const int x = (axis_ + 1) % 3, y = (axis_ + 2) % 3;
    const double left = (b[x] - a[x]) * (p[y] - a[y]);
    const double right = (b[y] - a[y]) * (p[x] - a[x]);
    const double size = std::abs(left) + std::abs(right);
    // Nothing was lost below or beyond the range of doubles.
    if (!(size > 1e-180 && size < 1e180)) return 0;
    const double turn = left - right, bound = 1e-15 * size;
    return turn > bound ? 1 : turn < -bound ? -1 : 0;
  }

  std::array<Vector3d, 3> corners_;
  Vector3d normal_, reach_;
  int axis_ = 0;  // nearest to the normal
  int turn_;      // of the corners, as seen along it
};

// Rotates the equal corners of two triangles to the front; returns how many.
int AlignCommonCorners(CornerPoints* a, CornerPoints* b) {
  int common = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = common; j < 3; ++j) {
      if ((*a)[i] != (*b)[j]) continue;
      std::swap((*a)[i], (*a)[common]);
      std::swap((*b)[j], (*b)[common]);
      ++common;
      break;
    }
  }
  return common;
}

// Whether both points lie on one edge of the triangle.
bool AreOnOneEdge(const Exact::Triangle_3& triangle, const Exact::Point_3& p,
                  const Exact::Point_3& q) {
  for (int k = 0; k < 3; ++k) {
    const Exact::Segment_3 edge(triangle[k], triangle[k + 1]);
    if (edge.has_on(p) && edge.has_on(q)) return true;
  }
  return false;
}

// Whether the inside of segment pq goes through the inside of the triangle.
bool Pierces(const Point& p, const Point& q, const CornerPoints& t) {
  const auto above = CGAL::orientation(t[0], t[1], t[2], p);
  if (above == CGAL::COPLANAR ||
      CGAL::orientation(t[0], t[1], t[2], q) != CGAL::opposite(above)) {
    return false;
  }
  const auto turn = CGAL::orientation(p, q, t[0], t[1]);
  return turn != CGAL::COPLANAR &&
         CGAL::orientation(p, q, t[1], t[2]) == turn &&
         CGAL::orientation(p, q, t[2], t[0]) == turn;
}

// Whether an edge of one pierces the other: all pairs in general position that
// meet.
bool IsAnyPierced(const CornerPoints& a, const CornerPoints& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (Pierces(a[k], a[(k + 1) % 3], b)) return true;
    if (Pierces(b[k], b[(k + 1) % 3], a)) return true;
  }
  return false;
}

// Whether the common part of two triangles, which is not empty, lies on an
// edge of each.  Constructs it: slow, but needed for few pairs.
bool TouchAlongEdges(const CornerPoints& a, const CornerPoints& b) {
  if (IsAnyPierced(a, b)) return false;
  const CGAL::Cartesian_converter<Kernel, Exact> to_exact;
  const Exact::Triangle_3 s = to_exact(ToTriangle(a));
  const Exact::Triangle_3 t = to_exact(ToTriangle(b));
  const CGAL::Object part = CGAL::intersection(s, t);
  if (const auto* p = CGAL::object_cast<Exact::Point_3>(&part)) {
    return AreOnOneEdge(s, *p, *p) && AreOnOneEdge(t, *p, *p);
  }
  if (const auto* e = CGAL::object_cast<Exact::Segment_3>(&part)) {
    return AreOnOneEdge(s, e->source(), e->target()) &&
           AreOnOneEdge(t, e->source(), e->target());
  }
  return false;  // an area in a common plane
}

// Whether one of two proper triangles has a point inside the other.
bool MeetProperly(CornerPoints a, CornerPoints b) {
  switch (AlignCommonCorners(&a, &b)) {
    case 0:
      return CGAL::do_intersect(ToTriangle(a), ToTriangle(b)) &&
             !TouchAlongEdges(a, b);
    case 1:
      // The common part is convex and holds the corner; any ray in it from
      // there leaves one of the triangles through the opposite edge.
      return (CGAL::do_intersect(ToTriangle(a),
                                 Kernel::Segment_3(b[1], b[2])) ||
              CGAL::do_intersect(ToTriangle(b),
                                 Kernel::Segment_3(a[1], a[2]))) &&
             !TouchAlongEdges(a, b);
    case 2:
      // Only triangles of one plane on the same side of the edge overlap.
      return CGAL::orientation(a[0], a[1], a[2], b[2]) == CGAL::COPLANAR &&
             CGAL::coplanar_orientation(a[0], a[1], a[2], b[2]) ==
                 CGAL::POSITIVE;
    default:
      return true;
  }
}

std::vector<Box> BoxesOf(const TriangleMesh& mesh,
                         const std::vector<std::size_t>& triangles) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const std::size_t t : triangles) {
    const CornerPoints c = CornersOf(mesh, mesh.triangles[t]);
    boxes.emplace_back(c[0].bbox() + c[1].bbox() + c[2].bbox(), t);
  }
  return boxes;
}

// The triangles that have an area and whose own box meets `region`.
std::vector<std::size_t> ProperTriangles(const TriangleMesh& mesh,
                                         const BoundingBox& region) {
  std::vector<std::size_t> proper;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    const Vector3d& a = mesh.vertices[i];
    const Vector3d& b = mesh.vertices[j];
    const Vector3d& c = mesh.vertices[k];
    const bool is_near =
        (a.cwiseMin(b).cwiseMin(c).array() <= region.max.array()).all() &&
        (a.cwiseMax(b).cwiseMax(c).array() >= region.min.array()).all();
    if (is_near && !IsDegenerate(mesh, mesh.triangles[t])) proper.push_back(t);
  }
  return proper;
}

// A search for pairs of triangles with equal labels that meet properly, leaf by
// leaf of a tree in parallel: of each leaf, its triangles and those after them.
class SelfIntersectionSearch {
 public:
  SelfIntersectionSearch(const TriangleMesh& mesh,
                         const std::vector<int>& labels)
      : mesh_(mesh),
        labels_(labels),
        proper_(ProperTriangles(mesh, ComputeBounds(mesh))),
        boxes_(ProperBoxes()),
        tree_(boxes_, 4) {
    rounded_.reserve(proper_.size());
    for (const std::size_t t : proper_) {
      rounded_.emplace_back(mesh, mesh.triangles[t]);
    }
    for (std::size_t n = 0; n < tree_.nodes().size(); ++n) {
      if (tree_.nodes()[n].IsLeaf()) leaves_.push_back(static_cast<int>(n));
    }
  }

  // Sorted, the lower number of a pair first.
  std::vector<TrianglePair> FindPairs() const {
    std::vector<std::vector<TrianglePair>> met(leaves_.size());
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, leaves_.size(), kLeavesOfTask),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t l = range.begin(); l < range.end(); ++l) {
            FindPairsOfLeaf(tree_.nodes()[leaves_[l]], &met[l]);
          }
        });
    std::vector<TrianglePair> all;
    for (const std::vector<TrianglePair>& of_leaf : met) {
      all.insert(all.end(), of_leaf.begin(), of_leaf.end());
    }
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  std::vector<BoundingBox> ProperBoxes() const {
    std::vector<BoundingBox> boxes;
    boxes.reserve(proper_.size());
    for (const std::size_t t : proper_) {
      const auto& [i, j, k] = mesh_.triangles[t];
      const Vector3d& a = mesh_.vertices[i];
      const Vector3d& b = mesh_.vertices[j];
      const Vector3d& c = mesh_.vertices[k];
      boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
    }
    return boxes;
  }

  // Of boxes or nodes.
  template <typename A, typename B>
  static bool Overlap(const A& a, const B& b) {
    return (a.min.array() <= b.max.array()).all() &&
           (a.max.array() >= b.min.array()).all();
  }

  // Of proper_[i] and proper_[j]; what decides cheaply comes first.
  bool Meet(std::size_t i, std::size_t j) const {
    return Overlap(boxes_[i], boxes_[j]) &&
           labels_[proper_[i]] == labels_[proper_[j]] &&
           !rounded_[i].IsBeside(rounded_[j]) &&
           !rounded_[j].IsBeside(rounded_[i]) &&
           internal::MeetProperly(mesh_, proper_[i], proper_[j]);
  }

  void FindPairsOfLeaf(const BoxTree::Node& leaf,
                       std::vector<TrianglePair>* met) const {
    tree_.ForEach(
        [&](int node) { return Overlap(tree_.nodes()[node], leaf); },
        [&](int position) {
          const auto j = static_cast<std::size_t>(tree_.order()[position]);
          for (int own = leaf.first; own < leaf.first + leaf.count; ++own) {
            const auto i = static_cast<std::size_t>(tree_.order()[own]);
            if (j > i && Meet(i, j)) met->emplace_back(proper_[i], proper_[j]);
          }
          return true;
        });
  }

  const TriangleMesh& mesh_;
  const std::vector<int>& labels_;
  std::vector<std::size_t> proper_;
  std::vector<BoundingBox> boxes_;        // of proper_
  std::vector<RoundedTriangle> rounded_;  // of proper_
  BoxTree tree_;                          // over boxes_
  std::vector<int> leaves_;               // its nodes
};

}  // namespace

bool IsDegenerate(const TriangleMesh& mesh, const Triangle& triangle) {
  const CornerPoints c = CornersOf(mesh, triangle);
  return CGAL::collinear(c[0], c[1], c[2]);
}

bool MeetProperly(const TriangleMesh& mesh, std::size_t s, std::size_t t) {
  return MeetProperly(CornersOf(mesh, mesh.triangles[s]),
                      CornersOf(mesh, mesh.triangles[t]));
}

std::size_t CountSelfIntersections(const TriangleMesh& mesh,
                                   const std::vector<int>& labels,
                                   std::size_t limit,
                                   std::vector<TrianglePair>* pairs) {
  const std::vector<TrianglePair> all =
      SelfIntersectionSearch(mesh, labels).FindPairs();
  const std::size_t told = std::min(limit, all.size());
  if (told > 0) pairs->insert(pairs->end(), all.begin(), all.begin() + told);
  return all.size();
}

bool Intersect(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Box> boxes_a = BoxesOf(a, ProperTriangles(a, ComputeBounds(b)));
  std::vector<Box> boxes_b = BoxesOf(b, ProperTriangles(b, ComputeBounds(a)));
  bool found = false;
  CGAL::box_intersection_d(
      boxes_a.begin(), boxes_a.end(), boxes_b.begin(), boxes_b.end(),
      [&](const Box& s, const Box& t) {
        found = found || MeetProperly(CornersOf(a, a.triangles[s.info()]),
                                      CornersOf(b, b.triangles[t.info()]));
      });
  return found;
}

}  // namespace phongpd::internal
