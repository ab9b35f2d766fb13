// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/retraction/point_neighbors.h"

#include <algorithm>
#include <limits>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

using Eigen::Vector3d;

void PointNeighbors::Add(int point) {
  points_.push_back(point);
  if (points_.size() - in_tree_ > 32 + in_tree_ / 8) Rebuild();
}

void PointNeighbors::Clear() {
  points_.clear();
  in_tree_ = 0;
  tree_ = BoxTree();
}

void PointNeighbors::Rebuild() {
  std::vector<BoundingBox> boxes;
  boxes.reserve(points_.size());
  for (const int point : points_) boxes.push_back({At(point), At(point)});
  tree_ = BoxTree(boxes, 4);
  in_tree_ = points_.size();
}

const std::vector<int>& PointNeighbors::Nearest(const Vector3d& q,
                                                std::size_t k) {
  best_.clear();
  const auto offer = [&](int point) {
    const Candidate candidate = {(At(point) - q).squaredNorm(), point};
    if (best_.size() == k) {
      if (!(candidate < best_.front())) return;
      std::pop_heap(best_.begin(), best_.end());
      best_.pop_back();
    }
    best_.push_back(candidate);
    std::push_heap(best_.begin(), best_.end());
  };
  const auto limit = [&] {
    return best_.size() < k ? std::numeric_limits<double>::max()
                            : best_.front().squared;
  };
  for (std::size_t i = in_tree_; i < points_.size(); ++i) offer(points_[i]);
  // A box of one point is as far as the point, to the bit.
  tree_.NearestFirst(
      limit(), [&](int node) { return tree_.nodes()[node].SquaredDistance(q); },
      [&](int position) {
        offer(points_[static_cast<std::size_t>(tree_.order()[position])]);
        return limit();
      });
  std::sort_heap(best_.begin(), best_.end());
  found_.clear();
  for (const Candidate& c : best_) found_.push_back(c.point);
  return found_;
}

int PointNeighbors::FindTwin(const Vector3d& q, double distance) {
  const std::vector<int>& nearest = Nearest(q, 1);
  const bool has_twin =
      !nearest.empty() && (At(nearest[0]) - q).norm() <= distance;
  return has_twin ? nearest[0] : -1;
}

}  // namespace phongpd
