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

class Centering {
 public:
  Centering(const ContactSurface& surface, const SegmentTree& segments,
            double clearance)
      : surface_(surface), segments_(segments), clearance_(clearance) {}

  void Run(std::vector<Vector3d>* path) const {
    // Twice: a neighbour that has not moved yet holds a point back.
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t k = 1; k + 1 < path->size(); ++k) Raise(k, path);
    }
    for (int round = 0; round < kRounds; ++round) {
      if (!Split(path)) return;
    }
  }

 private:
  double Room(const Vector3d& a, const Vector3d& b) const {
    return segments_.Distance(a, b, clearance_);
  }

  // Moves point k of the path, which has points on either side.
  bool Raise(std::size_t k, std::vector<Vector3d>* path) const {
    const Vector3d before = (*path)[k - 1], after = (*path)[k + 1];
    Vector3d& p = (*path)[k];
    double room = std::min(Room(before, p), Room(p, after));
    bool raised = false;
    for (int move = 0; move < kMoves && room < clearance_; ++move) {
      const Vector3d contact = surface_.Answer(p, Location::kOutside).contact;
      const double distance = (p - contact).norm();
      if (!(distance > 0.0) || distance >= clearance_) break;
      const Vector3d up = (p - contact) / distance;
      const SegmentTree::Hit hit =
          segments_.FirstHit(p, p + 2.0 * clearance_ * up);
      const double gap = distance + hit.fraction * 2.0 * clearance_;
      const double height = std::min(clearance_, 0.5 * gap);
      bool moved = false;
      for (double share = 1.0; share > 0.2 && !moved; share *= 0.5) {
        const Vector3d x = p + share * (height - distance) * up;
        const double now = std::min(Room(before, x), Room(x, after));
        if (now >= room && Room(x, x) > 1.01 * distance) {
          p = x;
          room = now;
          moved = true;
        }
      }
      if (!moved) break;
      raised = true;
    }
    return raised;
  }

  // A point in every segment that comes much nearer than both its ends.
  bool Split(std::vector<Vector3d>* path) const {
    bool changed = false;
    std::vector<Vector3d> old;
    old.swap(*path);
    path->push_back(old.front());
    for (std::size_t k = 1; k < old.size(); ++k) {
      const Vector3d a = path->back();
      const Vector3d b = old[k];
      const double room = Room(a, b);
      if (room < 0.6 * std::min(Room(a, a), Room(b, b))) {
        path->push_back(Nearest(a, b));
        path->push_back(b);
        if (Raise(path->size() - 2, path)) {
          changed = true;
        } else {
          path->pop_back();
          path->back() = b;
        }
      } else {
        path->push_back(b);
      }
    }
    return changed;
  }

  // About where the segment is nearest to the surface.
  Vector3d Nearest(Vector3d a, Vector3d b) const {
    for (int i = 0; i < kBisections; ++i) {
      const Vector3d middle = 0.5 * (a + b);
      (Room(a, middle) < Room(middle, b) ? b : a) = middle;
    }
    return 0.5 * (a + b);
  }

  const ContactSurface& surface_;
  const SegmentTree& segments_;
  double clearance_;
};

}  // namespace

void CenterPath(const ContactSurface& surface, const SegmentTree& segments,
                double clearance, std::vector<Vector3d>* path) {
  if (path->size() > 1 && clearance > 0.0) {
    Centering(surface, segments, clearance).Run(path);
  }
}

}  // namespace phongpd
