// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace phongpd {

// Configurations and the straight free motions between them, with their
// connected components: what a tree or a roadmap grows.  Points and edges are
// only ever added, and numbered from 0 in that order.
class MotionGraph {
 public:
  int AddPoint(const Eigen::Vector3d& q);

  // Joins the points by an edge each along a polyline that starts at point
  // `from` (path[0], not added again).  Ends in the point `to` if that is
  // given (path.back(), not added again); a path of one point then joins two
  // that coincide.  Returns the last point's number.
  int AddPath(int from, const std::vector<Eigen::Vector3d>& path, int to = -1);

  bool AreConnected(int a, int b) const { return Root(a) == Root(b); }

  // The shortest path along edges, a and b included (Dijkstra); empty if there
  // is none.
  std::vector<Eigen::Vector3d> ShortestPath(int a, int b) const;

  void Clear();

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  const std::vector<std::pair<int, int>>& edges() const { return edges_; }

 private:
  int Root(int point) const;
  void AddEdge(int a, int b);

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::pair<int, int>> edges_;
  std::vector<int> parent_;  // union-find, by size
  std::vector<int> size_;
};

}  // namespace phongpd
