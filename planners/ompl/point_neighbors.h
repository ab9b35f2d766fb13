// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/datastructures/NearestNeighborsGNATNoThreadSafety.h>

#include <Eigen/Core>
#include <vector>

#include "planners/retraction/motion_graph.h"

namespace phongpd {

// Nearest of some of a graph's points, in OMPL's geometric access tree.
class PointNeighbors {
 public:
  // The graph must outlive this.
  explicit PointNeighbors(const MotionGraph* graph) : graph_(*graph) {
    tree_.setDistanceFunction(
        [this](int a, int b) { return (At(a) - At(b)).norm(); });
  }
  PointNeighbors(const PointNeighbors&) = delete;
  PointNeighbors& operator=(const PointNeighbors&) = delete;

  void Add(int point) { tree_.add(point); }
  void Clear() { tree_.clear(); }
  std::size_t size() const { return tree_.size(); }

  // At most k points, nearest first.
  const std::vector<int>& Nearest(const Eigen::Vector3d& q, std::size_t k) {
    query_ = q;
    found_.clear();
    if (tree_.size() > 0) tree_.nearestK(kQuery, k, found_);
    return found_;
  }

  // The nearest point if it is that close, −1 otherwise.
  int FindTwin(const Eigen::Vector3d& q, double distance) {
    const std::vector<int>& nearest = Nearest(q, 1);
    const bool has_twin =
        !nearest.empty() && (At(nearest[0]) - q).norm() <= distance;
    return has_twin ? nearest[0] : -1;
  }

 private:
  static constexpr int kQuery = -1;

  const Eigen::Vector3d& At(int point) const {
    return point == kQuery ? query_
                           : graph_.points()[static_cast<std::size_t>(point)];
  }

  const MotionGraph& graph_;
  Eigen::Vector3d query_ = Eigen::Vector3d::Zero();
  ompl::NearestNeighborsGNATNoThreadSafety<int> tree_;
  std::vector<int> found_;
};

}  // namespace phongpd
