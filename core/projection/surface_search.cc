// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/surface_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace phongpd {
namespace {

using Eigen::Vector3d;

// How much more what is left counts than what is behind: fewer triangles are
// visited, and ways may be that much longer than the shortest.
constexpr double kGreed = 2.0;
// Sweeps that pull a way taut.
constexpr int kSweeps = 4;

// Where a + t (b − a) is in the ball; false if nowhere in [0, 1].
bool InBall(const SurfaceBall& ball, const Vector3d& a, const Vector3d& b,
            double* low, double* high) {
  const Vector3d e = b - a, to_a = a - ball.center;
  const double squared = e.squaredNorm(), half = to_a.dot(e);
  const double over = to_a.squaredNorm() - ball.radius * ball.radius;
  *low = 0.0;
  *high = 1.0;
  if (!(squared > 0.0)) return over <= 0.0;
  const double discriminant = half * half - squared * over;
  if (!(discriminant >= 0.0)) return false;
  const double root = std::sqrt(discriminant);
  *low = std::max(0.0, (-half - root) / squared);
  *high = std::min(1.0, (-half + root) / squared);
  return *low <= *high;
}

// The t in [low, high] for which the way from x by a + t (b − a) to y is the
// shortest: straight, once y is turned about the edge into one plane with x.
double Straightest(const Vector3d& a, const Vector3d& b, const Vector3d& x,
                   const Vector3d& y, double low, double high) {
  const Vector3d e = b - a;
  const double squared = e.squaredNorm();
  if (!(squared > 0.0)) return low;
  const double along_x = (x - a).dot(e) / squared;
  const double along_y = (y - a).dot(e) / squared;
  const double off_x = (x - a - along_x * e).norm();
  const double off_y = (y - a - along_y * e).norm();
  const double off = off_x + off_y;
  const double t =
      off > 0.0 ? along_x + (along_y - along_x) * (off_x / off) : along_y;
  return std::clamp(t, low, high);
}

}  // namespace

struct SurfaceSearch::Goal {
  const SurfaceBall* ball;
  Vector3d point;  // to be neared
  double radius;   // how near is near enough
  bool stay;       // in the ball

  double Left(const Vector3d& x) const {
    return std::max(0.0, (x - point).norm() - radius);
  }
};

void SurfaceSearch::Begin(const SurfaceWalk& walk, const MeshPoint& start,
                          const Goal& goal) {
  entries_.resize(walk.size());
  heap_.clear();
  settled_.clear();
  ++search_;
  Entry& first = entries_[start.triangle];
  first = Entry();
  first.search = search_;
  first.point = walk.At(start);
  heap_.emplace_back(goal.Left(first.point), start.triangle);
}

int SurfaceSearch::NextTriangle() {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const int triangle = heap_.back().second;
    heap_.pop_back();
    Entry& entry = entries_[triangle];
    if (entry.settled) continue;
    entry.settled = true;
    settled_.push_back(triangle);
    return triangle;
  }
  return -1;
}

void SurfaceSearch::Expand(const SurfaceWalk& walk, const Goal& goal,
                           int triangle) {
  const TriangleCorners& corners = walk.corners(triangle);
  const Entry here = entries_[triangle];
  for (int k = 0; k < 3; ++k) {
    const int next = walk.neighbors(triangle)[k];
    Entry& entry = entries_[next];
    const bool known = entry.search == search_;
    if (known && entry.settled) continue;
    const Vector3d &a = corners[k], &b = corners[(k + 1) % 3];
    double low = 0.0, high = 1.0;
    if (goal.stay && !InBall(*goal.ball, a, b, &low, &high)) continue;
    const double t = Straightest(a, b, here.point, goal.point, low, high);
    const Vector3d point = a + t * (b - a);
    const double cost = here.cost + (point - here.point).norm();
    if (known && entry.cost <= cost) continue;
    entry = {search_, false, triangle, k, t, cost, point};
    heap_.emplace_back(cost + kGreed * goal.Left(point), next);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  }
}

void SurfaceSearch::AppendWay(const SurfaceWalk& walk, const Goal& goal,
                              const Vector3d& start, const MeshPoint& end,
                              SurfaceWay* way) {
  crossings_.clear();
  for (int at = end.triangle; entries_[at].parent >= 0;) {
    const Entry& entry = entries_[at];
    const TriangleCorners& t = walk.corners(entry.parent);
    Crossing crossing{
        entry.parent, entry.edge, t[entry.edge], t[(entry.edge + 1) % 3],
        0.0,          1.0,        entry.t};
    if (goal.stay) {
      InBall(*goal.ball, crossing.a, crossing.b, &crossing.low, &crossing.high);
    }
    crossings_.push_back(crossing);
    at = entry.parent;
  }
  std::reverse(crossings_.begin(), crossings_.end());
  const auto point = [](const Crossing& c) {
    return Vector3d(c.a + c.t * (c.b - c.a));
  };
  const Vector3d last = walk.At(end);
  const std::size_t size = crossings_.size();
  const auto pull = [&](std::size_t i) {
    Crossing& c = crossings_[i];
    c.t = Straightest(c.a, c.b, i == 0 ? start : point(crossings_[i - 1]),
                      i + 1 == size ? last : point(crossings_[i + 1]), c.low,
                      c.high);
  };
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < size; ++i) pull(i);
    for (std::size_t i = size; i-- > 0;) pull(i);
  }
  for (const Crossing& c : crossings_) {
    MeshPoint p;
    p.triangle = c.triangle;
    p.lambda[c.edge] = 1.0 - c.t;
    p.lambda[(c.edge + 1) % 3] = c.t;
    way->push_back(p);
  }
  way->push_back(end);
}

void SurfaceSearch::FindInside(const SurfaceWalk& walk, const SurfaceBall& ball,
                               const MeshPoint& start, const MeshPoint& goal,
                               SurfaceWay* way) {
  const Goal wanted{&ball, walk.At(goal), 0.0, true};
  Begin(walk, start, wanted);
  for (int at = NextTriangle(); at >= 0; at = NextTriangle()) {
    if (at == goal.triangle) {
      AppendWay(walk, wanted, walk.At(start), goal, way);
      return;
    }
    Expand(walk, wanted, at);
  }
  SurfaceFoot best = walk.FootOn(start.triangle, ball.center);
  for (const int at : settled_) {
    const SurfaceFoot foot = walk.FootOn(at, ball.center);
    if (foot.squared_distance < best.squared_distance) best = foot;
  }
  AppendWay(walk, wanted, walk.At(start), best.point, way);
}

bool SurfaceSearch::FindBall(const SurfaceWalk& walk, const SurfaceBall& ball,
                             const MeshPoint& start, SurfaceWay* way) {
  const Goal wanted{&ball, ball.center, ball.radius, false};
  Begin(walk, start, wanted);
  for (int at = NextTriangle(); at >= 0; at = NextTriangle()) {
    const SurfaceFoot foot = walk.FootOn(at, ball.center);
    if (foot.squared_distance <= ball.radius * ball.radius) {
      AppendWay(walk, wanted, walk.At(start), foot.point, way);
      return true;
    }
    Expand(walk, wanted, at);
  }
  return false;
}

}  // namespace phongpd
