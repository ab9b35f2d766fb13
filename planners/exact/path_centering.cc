// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/path_centering.h"

#include <algorithm>
#include <cmath>

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr int kMoves = 4;        // of a point in a round
constexpr int kRounds = 4;       // of inserting points
constexpr int kBisections = 12;  // of a segment
// Where a clearance is to be kept, segments keep that of their ends but for so
// much.
constexpr double kNearly = 0.99;

class Centering {
 public:
  Centering(const ContactSurface& surface, const TriangleBvh& segments,
            double clearance, double kept)
      : surface_(surface),
        segments_(segments),
        clearance_(clearance),
        kept_(kept) {}

  void Run(std::vector<Vector3d>* path) {
    for (const Vector3d& p : *path) points_.push_back(At(p));
    // Twice: a neighbour that has not moved yet holds a point back.
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t k = 1; k + 1 < points_.size(); ++k) Raise(k);
    }
    const int rounds = kept_ > 0.0 ? 2 * kRounds : kRounds;
    for (int round = 0; round < rounds && Split(); ++round) {
    }
    path->clear();
    for (const Point& p : points_) path->push_back(p.position);
  }

 private:
  struct Point {
    Vector3d position;
    Vector3d contact;  // closest
    double distance;   // to it
  };

  Point At(const Vector3d& p) const {
    const PenetrationResult answer = surface_.Answer(p, Location::kOutside);
    return {p, answer.contact, (p - answer.contact).norm()};
  }

  // Clearance of a segment, at most that of its ends.
  double Room(const Point& a, const Point& b) const {
    return segments_.Distance(a.position, b.position,
                              std::min({clearance_, a.distance, b.distance}));
  }
  bool HasRoom(const Point& a, const Point& b, double room) const {
    return a.distance >= room && b.distance >= room &&
           !segments_.ComesWithin(a.position, b.position, room);
  }

  // Moves point k, which has points on either side.
  bool Raise(std::size_t k) {
    if (points_[k].distance >= clearance_) return false;
    const Point& before = points_[k - 1];
    const Point& after = points_[k + 1];
    Point& p = points_[k];
    double room = -1.0;  // not known yet
    bool raised = false;
    for (int move = 0; move < kMoves && p.distance < clearance_; ++move) {
      if (!(p.distance > 0.0)) break;
      const Vector3d up = (p.position - p.contact) / p.distance;
      const double reach = 2.0 * clearance_;
      const TriangleBvh::Hit hit =
          segments_.FirstHit(p.position, p.position + reach * up);
      const double gap = p.distance + hit.fraction * reach;
      const double way = std::min(clearance_, 0.5 * gap) - p.distance;
      if (!(way > 0.01 * p.distance)) break;
      if (room < 0.0) room = std::min(Room(before, p), Room(p, after));
      bool moved = false;
      for (double share = 1.0; share > 0.2 && !moved; share *= 0.5) {
        const Point x = At(p.position + share * way * up);
        moved = x.distance > 1.01 * p.distance && HasRoom(before, x, room) &&
                HasRoom(x, after, room);
        if (moved) p = x;
      }
      if (!moved) break;
      raised = true;
    }
    return raised;
  }

  // A point in every segment that comes much nearer than both its ends.
  bool Split() {
    bool changed = false;
    std::vector<Point> old;
    old.swap(points_);
    points_.push_back(old.front());
    for (std::size_t k = 1; k < old.size(); ++k) {
      const Point a = points_.back(), b = old[k];
      const double ends = std::min(a.distance, b.distance);
      const double wanted = std::max(0.6 * std::min(clearance_, ends),
                                     std::min(kept_, kNearly * ends));
      if (!HasRoom(a, b, wanted)) {
        points_.push_back(At(Nearest(a.position, b.position)));
        points_.push_back(b);
        if (Raise(points_.size() - 2)) {
          changed = true;
          continue;
        }
        points_.resize(points_.size() - 2);
      }
      points_.push_back(b);
    }
    return changed;
  }

  // About where the segment is nearest to the surface.
  Vector3d Nearest(Vector3d a, Vector3d b) const {
    for (int i = 0; i < kBisections; ++i) {
      const Vector3d middle = 0.5 * (a + b);
      const double left = segments_.Distance(a, middle, clearance_);
      (segments_.Distance(middle, b, left) < left ? a : b) = middle;
    }
    return 0.5 * (a + b);
  }

  const ContactSurface& surface_;
  const TriangleBvh& segments_;
  double clearance_, kept_;
  std::vector<Point> points_;
};

}  // namespace

void CenterPath(const ContactSurface& surface, const TriangleBvh& segments,
                double clearance, double kept, std::vector<Vector3d>* path) {
  if (path->size() > 1 && clearance > 0.0) {
    Centering(surface, segments, clearance, kept).Run(path);
  }
}

}  // namespace phongpd
