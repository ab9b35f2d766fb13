// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/path_shortening.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "constraints/free_space.h"
#include "core/bvh/triangle_bvh.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr int kCutsInVain = 60;  // in a row: no more are tried

// What a shortener asks of free space.
class RoomAround {
 public:
  explicit RoomAround(const FreeSpace& space) : space_(space) {}
  double Distance(const Vector3d& a, const Vector3d& b, double limit) const {
    return std::min(limit, space_.Clearance(a, b));
  }
  bool ComesWithin(const Vector3d& a, const Vector3d& b,
                   double distance) const {
    return !space_.IsFree(a, b) ||
           (distance > 0.0 && space_.Clearance(a, b) < distance);
  }

 private:
  const FreeSpace& space_;
};

// Of a TriangleBvh or RoomAround.
template <typename Room>
class Shortener {
 public:
  Shortener(const std::vector<Vector3d>& path, const Room& segments,
            const ShorteningOptions& options, double kept_share)
      : segments_(segments), options_(options), random_(options.seed) {
    for (std::size_t k = 0; k < path.size(); ++k) {
      points_.push_back({path[k], static_cast<double>(k), false});
      if (k == 0) continue;
      floor_.push_back(std::min(
          options.clearance,
          kept_share * segments.Distance(path[k - 1], path[k],
                                         options.clearance / kept_share)));
    }
  }

  std::vector<Vector3d> Run() {
    Gallop();
    int in_vain = 0;
    for (int i = 0; i < options_.random_cuts && points_.size() > 2; ++i) {
      in_vain = Cut() ? 0 : in_vain + 1;
      if (in_vain > kCutsInVain) break;
    }
    Gallop();
    double length = Length();
    for (int i = 0; i < options_.pulls && points_.size() > 2; ++i) {
      Pull();
      if (i % 3 == 2) Gallop();
      const double now = Length();
      if (now > length * (1.0 - 1e-4)) break;
      length = now;
    }
    std::vector<Vector3d> path;
    for (const Point& p : points_) path.push_back(p.position);
    return path;
  }

 private:
  // A point of the path and where it was on the path given.
  struct Point {
    Vector3d position;
    double parameter;
    bool settled = false;  // cannot be pulled while its neighbours stay
  };

  double Length() const {
    double length = 0.0;
    for (std::size_t k = 1; k < points_.size(); ++k) {
      length += (points_[k].position - points_[k - 1].position).norm();
    }
    return length;
  }

  // May the straight segment replace the path given from p to q?
  bool Sees(const Point& p, const Point& q) const {
    return SeesOver(p.position, q.position, p.parameter, q.parameter);
  }
  bool SeesOver(const Vector3d& a, const Vector3d& b, double from,
                double to) const {
    const std::size_t first =
        std::min(static_cast<std::size_t>(from), floor_.size() - 1);
    const std::size_t last =
        std::max(first + 1, static_cast<std::size_t>(std::ceil(to)));
    const double least =
        *std::min_element(floor_.begin() + static_cast<std::ptrdiff_t>(first),
                          floor_.begin() + static_cast<std::ptrdiff_t>(last));
    return !segments_.ComesWithin(a, b, least);
  }

  // From each point straight to the farthest that is found by doubling and
  // halving the stride.
  void Gallop() {
    std::vector<Point> kept = {points_.front()};
    for (std::size_t i = 0; i + 1 < points_.size();) {
      std::size_t good = i + 1, stride = 2;
      while (i + stride < points_.size() &&
             Sees(points_[i], points_[i + stride])) {
        good = i + stride;
        stride *= 2;
      }
      std::size_t bad = std::min(i + stride, points_.size());
      while (good + 1 < bad) {
        const std::size_t middle = (good + bad) / 2;
        (Sees(points_[i], points_[middle]) ? good : bad) = middle;
      }
      kept.push_back(points_[good]);
      i = good;
    }
    for (Point& p : kept) p.settled = false;
    points_ = std::move(kept);
  }

  Point At(std::size_t k, double share) const {
    const Point& p = points_[k];
    const Point& q = points_[k + 1];
    return {p.position + share * (q.position - p.position),
            p.parameter + share * (q.parameter - p.parameter), false};
  }

  bool Cut() {
    const std::size_t count = points_.size() - 1;
    std::size_t i = random_() % count, j = random_() % count;
    if (i == j) return false;
    if (i > j) std::swap(i, j);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const Point p = At(i, share(random_)), q = At(j, share(random_));
    double old = (points_[i + 1].position - p.position).norm() +
                 (q.position - points_[j].position).norm();
    for (std::size_t k = i + 1; k < j; ++k) {
      old += (points_[k + 1].position - points_[k].position).norm();
    }
    if ((q.position - p.position).norm() > old * (1.0 - 1e-6)) return false;
    // What is left of the two segments was part of them, but is measured
    // against its own stretch from now on.
    if (!Sees(points_[i], p) || !Sees(p, q) || !Sees(q, points_[j + 1]))
      return false;
    points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(i + 1),
                  points_.begin() + static_cast<std::ptrdiff_t>(j + 1));
    points_.insert(points_.begin() + static_cast<std::ptrdiff_t>(i + 1),
                   {p, q});
    return true;
  }

  void Pull() {
    for (std::size_t k = 1; k + 1 < points_.size(); ++k) {
      if (points_[k].settled) continue;
      points_[k].settled = true;
      Point& p = points_[k - 1];
      Point& q = points_[k + 1];
      const Vector3d along = q.position - p.position;
      const double squared = along.squaredNorm();
      const Vector3d here = points_[k].position;
      const double share =
          squared > 0.0
              ? std::clamp((here - p.position).dot(along) / squared, 0.0, 1.0)
              : 0.0;
      const Vector3d way = p.position + share * along - here;
      for (double step = 1.0; step > 0.1; step *= 0.5) {
        const Vector3d x = here + step * way;
        if (SeesOver(p.position, x, p.parameter, points_[k].parameter) &&
            SeesOver(x, q.position, points_[k].parameter, q.parameter)) {
          points_[k].position = x;
          p.settled = q.settled = points_[k].settled = false;
          break;
        }
      }
    }
  }

  const Room& segments_;
  const ShorteningOptions& options_;
  std::mt19937_64 random_;
  std::vector<Point> points_;
  std::vector<double> floor_;  // clearance asked of what replaces a segment
};

}  // namespace

std::vector<Vector3d> ShortenPath(const std::vector<Vector3d>& path,
                                  const TriangleBvh& segments,
                                  const ShorteningOptions& options,
                                  double kept_share) {
  if (path.size() < 3) return path;
  return Shortener<TriangleBvh>(path, segments, options, kept_share).Run();
}

std::vector<Vector3d> ShortenPath(const std::vector<Vector3d>& path,
                                  const FreeSpace& space,
                                  const ShorteningOptions& options,
                                  double kept_share) {
  if (path.size() < 3) return path;
  const RoomAround room(space);
  return Shortener<RoomAround>(path, room, options, kept_share).Run();
}

}  // namespace phongpd
