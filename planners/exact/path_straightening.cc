// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/path_straightening.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace phongpd {
namespace {

using Eigen::Vector3d;

class Straightener {
 public:
  Straightener(const FreeSpace& space, std::vector<Vector3d> path,
               const StraighteningOptions& options)
      : space_(space), options_(options), path_(std::move(path)) {
    for (const Vector3d& q : path_) {
      clearance_.push_back(space_.Clearance(q));
    }
  }

  // From each point to the farthest one it sees, of those 1, 2, 4, ... before
  // the end.
  void CutGreedily() {
    for (std::size_t i = 0; i + 2 < path_.size(); ++i) {
      for (std::size_t back = 0; i + 1 + back + 1 < path_.size();
           back = 2 * back + 1) {
        const std::size_t j = path_.size() - 1 - back;
        if (Allows(path_[i], path_[j], Required(i, j))) {
          Replace(i, j, {}, {});
          break;
        }
      }
    }
  }

  // Between two points uniform in the path's length.
  void CutRandomly(std::mt19937_64* random) {
    if (path_.size() < 3) return;
    std::vector<double> at = {0.0};
    for (std::size_t i = 1; i < path_.size(); ++i) {
      at.push_back(at.back() + (path_[i] - path_[i - 1]).norm());
    }
    std::uniform_real_distribution<double> uniform(0.0, at.back());
    double s = uniform(*random), t = uniform(*random);
    if (s > t) std::swap(s, t);
    const auto segment = [&](double x) {
      const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, x);
      return static_cast<std::size_t>(above - at.begin()) - 1;
    };
    const std::size_t i = segment(s), j = segment(t);
    if (i == j) return;
    const auto point = [&](std::size_t k, double x) {
      const double length = at[k + 1] - at[k];
      const double share = length > 0.0 ? (x - at[k]) / length : 0.0;
      return Vector3d(path_[k] + share * (path_[k + 1] - path_[k]));
    };
    const Vector3d a = point(i, s), b = point(j, t);
    if (!((b - a).norm() < t - s)) return;
    // The new corners are rounded: the pieces they end are judged as well.
    if (!Allows(a, b, Required(i, j + 1)) || !space_.IsFree(path_[i], a) ||
        !space_.IsFree(b, path_[j + 1])) {
      return;
    }
    Replace(i, j + 1, {a, b}, {space_.Clearance(a), space_.Clearance(b)});
  }

  StraightenedPath Take() {
    result_.points = std::move(path_);
    return std::move(result_);
  }

 private:
  // Clearance a cut must keep that replaces the part between two points.
  double Required(std::size_t i, std::size_t j) const {
    return std::min(
        options_.clearance,
        *std::min_element(
            clearance_.begin() + static_cast<std::ptrdiff_t>(i),
            clearance_.begin() + static_cast<std::ptrdiff_t>(j) + 1));
  }

  // The ends' own clearance may have been rounded.
  bool Allows(const Vector3d& a, const Vector3d& b, double clearance) {
    ++result_.tried;
    return space_.IsFree(a, b) &&
           (!(clearance > 0.0) ||
            space_.KeepsClearance(a, b, 0.999 * clearance));
  }

  // The points strictly between i and j by others.
  void Replace(std::size_t i, std::size_t j,
               const std::vector<Vector3d>& points,
               const std::vector<double>& clearances) {
    ++result_.taken;
    const auto first = static_cast<std::ptrdiff_t>(i) + 1;
    const auto last = static_cast<std::ptrdiff_t>(j);
    path_.erase(path_.begin() + first, path_.begin() + last);
    path_.insert(path_.begin() + first, points.begin(), points.end());
    clearance_.erase(clearance_.begin() + first, clearance_.begin() + last);
    clearance_.insert(clearance_.begin() + first, clearances.begin(),
                      clearances.end());
  }

  const FreeSpace& space_;
  const StraighteningOptions& options_;
  std::vector<Vector3d> path_;
  std::vector<double> clearance_;  // of the points
  StraightenedPath result_;
};

}  // namespace

StraightenedPath Straighten(const FreeSpace& space, std::vector<Vector3d> path,
                            const StraighteningOptions& options,
                            std::mt19937_64* random) {
  Straightener straightener(space, std::move(path), options);
  straightener.CutGreedily();
  for (int i = 0; i < options.random_cuts; ++i) {
    straightener.CutRandomly(random);
  }
  straightener.CutGreedily();
  return straightener.Take();
}

std::vector<Vector3d> ResampleKeepingCorners(
    const std::vector<Vector3d>& corners, int waypoints) {
  const std::size_t segments = corners.size() - 1;
  std::vector<Vector3d> path;
  if (corners.size() < 2 || waypoints + 1 < static_cast<int>(segments)) {
    return path;
  }
  // Give pieces, one by one, to the segment whose pieces are longest.
  std::vector<int> pieces(segments, 1);
  std::vector<double> length(segments);
  std::priority_queue<std::pair<double, std::size_t>> longest;
  for (std::size_t k = 0; k < segments; ++k) {
    length[k] = (corners[k + 1] - corners[k]).norm();
    longest.push({length[k], k});
  }
  for (int left = waypoints + 1 - static_cast<int>(segments); left > 0;
       --left) {
    const std::size_t k = longest.top().second;
    longest.pop();
    ++pieces[k];
    longest.push({length[k] / pieces[k], k});
  }
  for (std::size_t k = 0; k < segments; ++k) {
    for (int i = 0; i < pieces[k]; ++i) {
      const double share = static_cast<double>(i) / pieces[k];
      path.push_back(corners[k] + share * (corners[k + 1] - corners[k]));
    }
  }
  path.push_back(corners.back());
  return path;
}

}  // namespace phongpd
