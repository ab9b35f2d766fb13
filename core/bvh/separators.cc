// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/separators.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/bvh/segment_triangle_distance.h"
#include "core/mesh/numbers.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

using internal::kInfinity;
// Of a box's distance: what rounding may add to it, or take from a triangle's.
constexpr double kBoxRounding = 1e-12;
// Below it the inverse of a power of two is infinite; numbers that small are
// scaled by less, which their squares survive.
constexpr int kLeastExponent = -1022;

}  // namespace

Separator SeparatorOf(const TriangleCorners& corners, const Vector3d& a,
                      const Vector3d& b) {
  Separator found;
  found.corners = corners;
  // From a, and a power of two smaller: squares are finite, whatever the unit.
  std::array<Vector3d, 4> from_a = {
      0.5 * b - 0.5 * a, 0.5 * corners[0] - 0.5 * a, 0.5 * corners[1] - 0.5 * a,
      0.5 * corners[2] - 0.5 * a};
  double largest = 0.0;
  for (const Vector3d& x : from_a) {
    largest = std::max(largest, x.cwiseAbs().maxCoeff());
  }
  const int exponent =
      largest > 0.0 ? std::max(std::ilogb(largest), kLeastExponent) : 0;
  const double scale = std::ldexp(1.0, -exponent);
  for (Vector3d& x : from_a) x *= scale;
  const SegmentTrianglePair pair =
      ClosestPair(Vector3d::Zero(), from_a[0], from_a[1], from_a[2], from_a[3]);
  found.distance = std::ldexp(std::sqrt(pair.squared_distance), exponent + 1);
  const Vector3d apart = pair.on_segment - pair.on_triangle;
  if (!apart.isZero(0.0)) found.normal = apart.stableNormalized();
  // Wherever rounding put the pair, the triangle is below its plane.
  found.level = -kInfinity;
  for (const Vector3d& q : corners) {
    found.level = std::max(found.level, found.normal.dot(q));
  }
  return found;
}

SeparatorSearch::SeparatorSearch(const Vector3d& a, const Vector3d& b,
                                 double radius, double slack)
    : a_(a), b_(b), radius_(radius), slack_(slack) {}

bool SeparatorSearch::Needs(const BoxTree::Node& box) const {
  return Gap(box) <= radius_ && !IsHidden(box);
}

bool SeparatorSearch::IsHidden(const BoxTree::Node& box) const {
  const Vector3d center = 0.5 * (box.min - a_) + 0.5 * (box.max - a_);
  const Vector3d half = 0.5 * (box.max - box.min);
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const Vector3d& n = found_[i].normal;
    if (found_[i].distance > 0.0 &&
        n.dot(center) + n.cwiseAbs().dot(half) <= levels_[i] + slack_) {
      return true;
    }
  }
  return false;
}

double SeparatorSearch::Gap(const BoxTree::Node& box) const {
  const Vector3d low = a_.cwiseMin(b_), high = a_.cwiseMax(b_);
  const Vector3d gap = (box.min - high).cwiseMax(low - box.max).cwiseMax(0.0);
  const double distance = gap.norm();
  return (1.0 - kBoxRounding) *
         (std::isfinite(distance) ? distance : gap.stableNorm());
}

bool SeparatorSearch::IsHidden(const TriangleCorners& corners) const {
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (found_[i].distance > 0.0 &&
        std::all_of(corners.begin(), corners.end(), [&](const Vector3d& q) {
          return found_[i].normal.dot(q - a_) <= levels_[i] + slack_;
        })) {
      return true;
    }
  }
  return false;
}

void SeparatorSearch::Take(const Separator& separator) {
  double level = -kInfinity;
  for (const Vector3d& q : separator.corners) {
    level = std::max(level, separator.normal.dot(q - a_));
  }
  found_.push_back(separator);
  levels_.push_back(level);
}

// Of what is equally far, nodes come first, then triangles by their place: the
// order does not depend on the shape of the tree.
bool SeparatorSearch::IsLater(const Waiting& a, const Waiting& b) {
  if (a.distance != b.distance) return a.distance > b.distance;
  return std::make_tuple(a.node < 0, a.tree, a.position) >
         std::make_tuple(b.node < 0, b.tree, b.position);
}

void SeparatorSearch::Push(const Waiting& item) {
  queue_.push_back(item);
  std::push_heap(queue_.begin(), queue_.end(), IsLater);
}

void SeparatorSearch::Add(const TriangleBvh& tree) {
  if (tree.tree().nodes().empty()) return;
  trees_.push_back(&tree);
  Offer(static_cast<int>(trees_.size()) - 1, 0);
}

void SeparatorSearch::Offer(int tree, int node) {
  const BoxTree::Node& box = trees_[tree]->tree().nodes()[node];
  const double gap = Gap(box);
  if (gap <= radius_ && !IsHidden(box)) Push({gap, tree, node, 0});
}

void SeparatorSearch::AdvanceTo(double distance) {
  while (!queue_.empty() && queue_.front().distance < distance) {
    std::pop_heap(queue_.begin(), queue_.end(), IsLater);
    const Waiting item = queue_.back();
    queue_.pop_back();
    Open(item);
  }
}

void SeparatorSearch::Open(const Waiting& item) {
  const TriangleBvh& tree = *trees_[item.tree];
  if (item.node < 0) {
    const TriangleCorners& corners = tree.corners()[item.position];
    if (!IsHidden(corners)) Take(SeparatorOf(corners, a_, b_));
    return;
  }
  const BoxTree::Node& node = tree.tree().nodes()[item.node];
  if (IsHidden(node)) return;
  for (int k = 0; !node.IsLeaf() && k < 2; ++k) {
    Offer(item.tree, node.first + k);
  }
  for (int i = node.first; i < node.first + node.count; ++i) {
    const TriangleCorners& corners = tree.corners()[i];
    if (IsHidden(corners)) continue;
    const double distance = SeparatorOf(corners, a_, b_).distance;
    if (distance <= radius_) Push({distance, item.tree, -1, i});
  }
}

}  // namespace phongpd
