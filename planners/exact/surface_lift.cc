// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/surface_lift.h"

#include <algorithm>
#include <iterator>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr int kPushes = 8;   // steps up the distance gradient
constexpr int kPasses = 60;  // over the polyline, until all of it is free
constexpr int kMostPoints = 20000;

}  // namespace

bool SurfaceLift::Sees(const Vector3d& foot, const Vector3d& x) const {
  return !segments_.FirstHitBeyond(foot, x, tiny_).Found();
}

bool SurfaceLift::Raise(double limit, Point* point) const {
  if (!(point->direction.squaredNorm() > 0.0)) return false;
  const Vector3d& foot = point->foot;
  const SegmentTree::Hit hit = segments_.FirstHitBeyond(
      foot, foot + 2.0 * limit * point->direction, tiny_);
  point->height = hit.Found() ? hit.fraction * limit : limit;
  if (!(point->height > lowest_)) return false;
  Vector3d x = point->Position();
  if (!space_.IsFree(x)) return false;
  FreeSpace::Nearest nearest = space_.FindNearest(x);
  for (int i = 0; i < kPushes && nearest.distance < limit; ++i) {
    // The full step reaches the limit above a plane; in a channel, half the
    // step may still gain.
    bool gained = false;
    for (double step = limit - nearest.distance; step > 0.05 * limit;
         step *= 0.5) {
      const Vector3d y = x + step * nearest.direction;
      if (!space_.IsFree(y)) continue;
      const FreeSpace::Nearest there = space_.FindNearest(y);
      if (there.distance < nearest.distance + 0.1 * step || !Sees(foot, y)) {
        continue;
      }
      x = y;
      nearest = there;
      gained = true;
      break;
    }
    if (!gained) break;
  }
  point->height = (x - foot).norm();
  point->direction = (x - foot) / point->height;
  return true;
}

std::vector<Vector3d> SurfaceLift::Lift(const Point& before,
                                        const Geodesic& geodesic,
                                        const Point& after,
                                        LiftCounters* counters) const {
  std::list<Point> points = {before};
  for (const GeodesicPoint& p : geodesic.points) {
    Point point = {p.position, p.normal, 0.0, p.triangle};
    // A point that cannot be lifted is left out; if that closes the way, the
    // middle of the gap is lifted below.
    if (Raise(margin_, &point)) points.push_back(point);
    ++counters->lifted;
  }
  points.push_back(after);

  bool is_free = false;
  for (int pass = 0; pass < kPasses && !is_free; ++pass) {
    is_free = true;
    for (auto a = points.begin(); std::next(a) != points.end(); ++a) {
      const auto b = std::next(a);
      if (space_.IsFree(a->Position(), b->Position())) continue;
      is_free = false;
      if (static_cast<int>(points.size()) > kMostPoints) return {};
      // Between two feet of one triangle, another one may help; it is free to
      // be lower than its neighbours.
      const bool is_apart = (a->foot - b->foot).norm() > lowest_;
      if (is_apart && pass % 2 == 0) {
        const Vector3d& normal = facet_normals_[a->triangle];
        Point middle = {0.5 * (a->foot + b->foot), normal, 0.0, a->triangle};
        ++counters->lifted;
        if (Raise(std::max(a->height, b->height), &middle)) {
          a = points.insert(b, middle);
          continue;
        }
      }
      Point& larger = a->height > b->height ? *a : *b;
      larger.height *= 0.5;
      ++counters->lowered;
      if (larger.height < lowest_) return {};
    }
  }
  std::vector<Vector3d> path;
  if (!is_free) return path;
  for (const Point& point : points) path.push_back(point.Position());
  return path;
}

}  // namespace phongpd::internal
