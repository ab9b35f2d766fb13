// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/bvh/box_tree.h"
#include "planners/retraction/motion_graph.h"

namespace phongpd {

// Nearest of some of a graph's points.  Of points equally far the one with the
// smaller number is nearer, so that answers depend on nothing else: start and
// goal are often equally far from a sample.
//
// A box tree holds most points; those added since are scanned, until there are
// an eighth as many and the tree is made anew.
class PointNeighbors {
 public:
  // The graph must outlive this.
  explicit PointNeighbors(const MotionGraph* graph) : graph_(*graph) {}

  // A number of the graph's points, not there yet.
  void Add(int point);
  void Clear();
  std::size_t size() const { return points_.size(); }

  // At most k ≥ 1 points, nearest first; valid until the next call.
  const std::vector<int>& Nearest(const Eigen::Vector3d& q, std::size_t k);
  // The nearest point if it is that close, −1 otherwise.
  int FindTwin(const Eigen::Vector3d& q, double distance);

 private:
  struct Candidate {
    double squared;
    int point;
    bool operator<(const Candidate& other) const {
      return squared != other.squared ? squared < other.squared
                                      : point < other.point;
    }
  };

  const Eigen::Vector3d& At(int point) const {
    return graph_.points()[static_cast<std::size_t>(point)];
  }
  void Rebuild();

  const MotionGraph& graph_;
  std::vector<int> points_;
  std::size_t in_tree_ = 0;  // the first so many
  BoxTree tree_;
  std::vector<Candidate> best_;  // a heap, the farthest on top
  std::vector<int> found_;
};

}  // namespace phongpd
