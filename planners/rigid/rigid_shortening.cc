// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/rigid_shortening.h"

#include <algorithm>
#include <cstddef>

#include "planners/rigid/object_norm.h"

namespace phongpd::internal {
namespace {

// Cuts in vain, one after the other, after which it ends, and of all.
constexpr int kVainCuts = 200;
constexpr int kMaxCuts = 1000;
// A cut gains more than that share of what it replaces.
constexpr double kLeastGain = 1e-3;

using RigidPath = std::vector<RobotPose>;

// From each kept pose to the farthest it is seen to reach: doubled hops while
// they are free, then halved.
void DropPoses(RigidLinks* links, RigidPath* path) {
  RigidPath kept = {path->front()};
  std::size_t at = 0;
  while (at + 1 < path->size()) {
    std::size_t reached = at + 1, hop = 2;
    const auto reaches = [&](std::size_t to) {
      return links->IsFree((*path)[at], (*path)[to]);
    };
    while (at + hop < path->size() && reaches(at + hop)) {
      reached = at + hop;
      hop *= 2;
    }
    for (hop /= 2; hop > 0; hop /= 2) {
      if (reached + hop < path->size() && reaches(reached + hop)) {
        reached += hop;
      }
    }
    kept.push_back((*path)[reached]);
    at = reached;
  }
  *path = kept;
}

// A place of the path: `share` of the way from pose `link` to the next.
struct PathPlace {
  std::size_t link;
  double share;
};

class PathCutter {
 public:
  PathCutter(double gyration, RigidLinks* links, RigidPath* path)
      : gyration_(gyration), links_(links), path_(*path) {}

  // True: the way between two random places got shorter.
  bool Cut(std::mt19937_64* random) {
    Measure();
    std::uniform_real_distribution<double> anywhere(0.0, sums_.back());
    double from = anywhere(*random), to = anywhere(*random);
    if (to < from) std::swap(from, to);
    const PathPlace a = PlaceOf(from), b = PlaceOf(to);
    if (a.link == b.link) return false;
    const RobotPose start = PoseAt(a), end = PoseAt(b);
    const double direct = ObjectDistance(start, end, gyration_);
    if (!(direct < (1.0 - kLeastGain) * (to - from))) return false;
    // Parts of a motion are motions of their own: to rounding only.
    if (!links_->IsFree(start, end) || !links_->IsFree(path_[a.link], start) ||
        !links_->IsFree(end, path_[b.link + 1])) {
      return false;
    }
    RigidPath cut(path_.begin(), Iterator(a.link + 1));
    if (a.share > 0.0) cut.push_back(start);
    if (b.share < 1.0) cut.push_back(end);
    cut.insert(cut.end(), Iterator(b.link + 1), path_.end());
    path_ = cut;
    return true;
  }

 private:
  RigidPath::iterator Iterator(std::size_t i) {
    return path_.begin() + static_cast<std::ptrdiff_t>(i);
  }

  void Measure() {
    sums_.assign(1, 0.0);
    for (std::size_t i = 1; i < path_.size(); ++i) {
      sums_.push_back(sums_.back() +
                      ObjectDistance(path_[i - 1], path_[i], gyration_));
    }
  }

  PathPlace PlaceOf(double length) const {
    const auto next = std::upper_bound(sums_.begin() + 1, sums_.end(), length);
    const std::size_t link = std::min(
        static_cast<std::size_t>(next - sums_.begin()) - 1, path_.size() - 2);
    const double link_length = sums_[link + 1] - sums_[link];
    const double share =
        link_length > 0.0 ? (length - sums_[link]) / link_length : 0.0;
    return {link, std::clamp(share, 0.0, 1.0)};
  }

  RobotPose PoseAt(const PathPlace& place) const {
    if (place.share <= 0.0) return path_[place.link];
    if (place.share >= 1.0) return path_[place.link + 1];
    return RigidMotion(path_[place.link], path_[place.link + 1])
        .At(place.share);
  }

  const double gyration_;
  RigidLinks* links_;
  RigidPath& path_;
  std::vector<double> sums_;
};

}  // namespace

void ShortenRigidPath(double gyration, long max_tests, RigidLinks* links,
                      std::mt19937_64* random, RigidPath* path) {
  if (path->size() < 3) return;
  const long most = links->tests() + max_tests;
  DropPoses(links, path);
  PathCutter cutter(gyration, links, path);
  int vain = 0;
  for (int i = 0; i < kMaxCuts && vain < kVainCuts; ++i) {
    if (path->size() < 3 || links->IsStopped()) break;
    if (links->tests() >= most) break;
    vain = cutter.Cut(random) ? 0 : vain + 1;
  }
  DropPoses(links, path);
}

}  // namespace phongpd::internal
