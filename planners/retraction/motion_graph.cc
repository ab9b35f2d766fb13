// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/retraction/motion_graph.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>

#include "core/mesh/numbers.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

using internal::At;

}  // namespace

int MotionGraph::AddPoint(const Vector3d& q) {
  points_.push_back(q);
  parent_.push_back(static_cast<int>(parent_.size()));
  size_.push_back(1);
  return parent_.back();
}

int MotionGraph::AddPath(int from, const std::vector<Vector3d>& path, int to) {
  int last = from;
  const std::size_t kept = to >= 0 ? 1 : 0;
  for (std::size_t k = 1; k + kept < path.size(); ++k) {
    const int next = AddPoint(path[k]);
    AddEdge(last, next);
    last = next;
  }
  if (to < 0 || to == last) return last;
  AddEdge(last, to);
  return to;
}

void MotionGraph::AddEdge(int a, int b) {
  edges_.emplace_back(a, b);
  int root = Root(a), leaf = Root(b);
  if (root == leaf) return;
  if (size_[At(root)] < size_[At(leaf)]) std::swap(root, leaf);
  parent_[At(leaf)] = root;
  size_[At(root)] += size_[At(leaf)];
}

// By size the trees are logarithmically deep; no compression, so it is const.
int MotionGraph::Root(int point) const {
  while (parent_[At(point)] != point) point = parent_[At(point)];
  return point;
}

std::vector<Vector3d> MotionGraph::ShortestPath(int a, int b) const {
  if (!AreConnected(a, b)) return {};
  std::vector<std::vector<int>> neighbors(points_.size());
  for (const auto& [i, j] : edges_) {
    neighbors[At(i)].push_back(j);
    neighbors[At(j)].push_back(i);
  }
  std::vector<double> length(points_.size(),
                             std::numeric_limits<double>::infinity());
  std::vector<int> previous(points_.size(), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  length[At(a)] = 0.0;
  queue.emplace(0.0, a);
  while (!queue.empty()) {
    const auto [so_far, i] = queue.top();
    queue.pop();
    if (i == b) break;
    if (so_far > length[At(i)]) continue;
    for (const int j : neighbors[At(i)]) {
      const double along = so_far + (points_[At(j)] - points_[At(i)]).norm();
      if (along >= length[At(j)]) continue;
      length[At(j)] = along;
      previous[At(j)] = i;
      queue.emplace(along, j);
    }
  }
  std::vector<Vector3d> path;
  for (int i = b; i >= 0; i = previous[At(i)]) path.push_back(points_[At(i)]);
  std::reverse(path.begin(), path.end());
  return path;
}

void MotionGraph::Clear() { *this = MotionGraph(); }

}  // namespace phongpd
