// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/path_recombination.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>

#include "constraints/free_space.h"
#include "core/bvh/triangle_bvh.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

struct Corner {
  Vector3d point;
  double clearance;
  std::size_t path;   // it comes from
  std::size_t index;  // on that path
};

// A way to a corner; whether its last segment is free is asked when the way
// comes first.
struct Way {
  double bound;   // of a path that goes on from here
  double length;  // up to here
  int to, from;   // corners

  bool operator>(const Way& other) const {
    if (bound != other.bound) return bound > other.bound;
    return std::pair(to, from) > std::pair(other.to, other.from);
  }
};

// Is the segment from a to b on one of the paths, and so known to be free?
// The start is corner 0 and the goal corner 1; they are on every path.
bool AreNeighbors(const Corner& a, const Corner& b,
                  const std::vector<RoutedPath>& paths, bool is_start,
                  bool is_goal) {
  if (is_start && is_goal) {
    return std::any_of(paths.begin(), paths.end(), [](const RoutedPath& p) {
      return p.points.size() == 2;
    });
  }
  if (is_start) return b.index == 1;
  if (is_goal) return a.index + 2 == paths[a.path].points.size();
  return a.path == b.path && (a.index + 1 == b.index || b.index + 1 == a.index);
}

std::vector<Corner> CollectCorners(const std::vector<RoutedPath>& paths) {
  // The ends are on every path, so the other end of a segment decides.
  double most = 0.0;
  for (const RoutedPath& p : paths) most = std::max(most, p.clearance);
  std::vector<Corner> corners = {{paths[0].points.front(), most, 0, 0},
                                 {paths[0].points.back(), most, 0, 0}};
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t k = 1; k + 1 < paths[i].points.size(); ++k) {
      corners.push_back({paths[i].points[k], paths[i].clearance, i, k});
    }
  }
  return corners;
}

// Points at shares 0, 1/n … 1 of the length.
std::vector<Vector3d> EvenPoints(const std::vector<Vector3d>& path, int n) {
  const double length = PathLength(path);
  std::vector<Vector3d> points = {path.front()};
  double done = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double step = (path[k] - path[k - 1]).norm();
    while (static_cast<int>(points.size()) < n) {
      const double at = length * static_cast<double>(points.size()) / n - done;
      if (!(at <= step)) break;
      points.push_back(path[k - 1] + (step > 0.0 ? at / step : 0.0) *
                                         (path[k] - path[k - 1]));
    }
    done += step;
  }
  points.resize(static_cast<std::size_t>(n), path.back());
  points.push_back(path.back());
  return points;
}

}  // namespace

bool TakeSameWay(const std::vector<Vector3d>& one,
                 const std::vector<Vector3d>& other, double tolerance) {
  constexpr int kShares = 32;
  const double close = tolerance * PathLength(one);
  const std::vector<Vector3d> a = EvenPoints(one, kShares);
  const std::vector<Vector3d> b = EvenPoints(other, kShares);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!((a[i] - b[i]).norm() <= close)) return false;
  }
  return true;
}

std::vector<Vector3d> RecombinePaths(const std::vector<RoutedPath>& paths,
                                     const TriangleBvh& segments) {
  if (paths.empty()) return {};
  const std::vector<Corner> corners = CollectCorners(paths);
  const Vector3d& goal = corners[1].point;
  const auto is_free = [&](int from, int to) {
    const Corner& a = corners[from];
    const Corner& b = corners[to];
    return AreNeighbors(a, b, paths, from == 0, to == 1) ||
           !segments.ComesWithin(a.point, b.point,
                                 std::min(a.clearance, b.clearance));
  };
  const int count = static_cast<int>(corners.size());
  std::vector<int> parent(corners.size(), -1);
  std::priority_queue<Way, std::vector<Way>, std::greater<>> open;
  open.push({0.0, 0.0, 0, 0});
  while (parent[1] < 0) {
    const Way way = open.top();
    open.pop();
    if (parent[way.to] >= 0) continue;
    if (way.to != 0 && !is_free(way.from, way.to)) continue;
    parent[way.to] = way.from;
    for (int next = 1; next < count; ++next) {
      if (parent[next] >= 0) continue;
      const Vector3d& point = corners[next].point;
      const double length = way.length + (point - corners[way.to].point).norm();
      open.push({length + (goal - point).norm(), length, next, way.to});
    }
  }
  std::vector<Vector3d> path;
  for (int at = 1; at != 0; at = parent[at]) path.push_back(corners[at].point);
  path.push_back(corners[0].point);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace phongpd
