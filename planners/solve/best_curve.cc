// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/best_curve.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>

#include "core/stopwatch.h"
#include "planners/trajectory/curve_rests.h"
#include "planners/trajectory/curve_search.h"
#include "planners/trajectory/least_duration.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// The share of a required margin that counts as all of it, and that is wished
// for, as interior points end a little before their rows.
constexpr double kRequired = 1.0 - 1e-6;
constexpr double kMoreThanRequired = 1.001;
// Of D: paths that are nowhere further apart are one way.
constexpr double kAlike = 0.02;
// A motion that takes no longer, as a share of the least time, needs no other
// way.
constexpr double kNearLeast = 1.1;
// Of a way that is compared with the first one: where it has more, another one
// is better by little, and takes as long to look at as to make the first
// better.
constexpr std::size_t kMostCorners = 32;

bool IsBetterCurve(const CurveSummary& a, const CurveSummary& b,
                   const CurveOptions& options, bool margin_is_required) {
  if (a.trajectory.empty() || b.trajectory.empty()) {
    // The least duration that is known counts where none is short enough.
    return !a.trajectory.empty() ||
           (b.trajectory.empty() && a.duration < b.duration);
  }
  const double least = margin_is_required ? kRequired * options.margin : 0.0;
  if ((a.margin >= least) != (b.margin >= least)) return a.margin >= least;
  if (options.duration > 0.0) {
    return SquaredJerk(a.trajectory, options.limits) <
           SquaredJerk(b.trajectory, options.limits);
  }
  return a.cost < b.cost;
}

// Is every corner of `path` that near to the other one?
bool IsNear(const Path& path, const Path& other, double distance) {
  return std::all_of(path.begin(), path.end(), [&](const Vector3d& q) {
    for (std::size_t i = 1; i < other.size(); ++i) {
      const Vector3d edge = other[i] - other[i - 1];
      const double length = edge.squaredNorm();
      const double s =
          length > 0.0
              ? std::clamp((q - other[i - 1]).dot(edge) / length, 0.0, 1.0)
              : 0.0;
      if ((other[i - 1] + s * edge - q).norm() <= distance) return true;
    }
    return false;
  });
}

// Seconds along it at the limits of velocity.
double FastestAlong(const Path& path, const MotionLimits& limits) {
  double seconds = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    seconds += LeastDuration(path[i] - path[i - 1], limits, false);
  }
  return seconds;
}

class Contest {
 public:
  Contest(const FreeSpace& space, double diagonal,
          const std::vector<Path>& paths, const CurveOptions& options,
          bool margin_is_required)
      : space_(space),
        diagonal_(diagonal),
        paths_(paths),
        options_(options),
        margin_is_required_(margin_is_required),
        entries_(paths.size()) {}

  BestCurve Run(std::size_t refined) {
    const bool is_compared = paths_.size() > refined &&
                             options_.duration == 0.0 && !margin_is_required_ &&
                             !HasRests(options_);
    const std::vector<std::size_t> done =
        is_compared ? RefineBest(refined) : OptimizeFirst(refined);
    BestCurve best;
    best.path = done.front();
    for (const std::size_t i : done) {
      if (IsBetter(i, best.path)) best.path = i;
    }
    for (const Entry& entry : entries_) {
      best.tried += entry.is_tried ? 1 : 0;
      best.motions.push_back(entry.found.trajectory);
    }
    best.summary = std::move(entries_[best.path].found);
    best.summary.margin = std::min(best.summary.margin, options_.margin);
    best.summary.seconds = stopwatch_.Seconds();
    return best;
  }

 private:
  struct Entry {
    CurveOptions options;
    std::unique_ptr<CurveSearch> search;
    CurveSummary found;
    bool is_tried = false;
  };

  bool IsBetter(std::size_t i, std::size_t than) const {
    const Entry &one = entries_[i], &other = entries_[than];
    return i != than && one.is_tried &&
           one.found.status != PathStatus::kNotFree &&
           IsBetterCurve(one.found, other.found, options_, margin_is_required_);
  }

  // Of a path whose turn it is; false if it comes too late.
  bool Enter(std::size_t i) {
    Entry& entry = entries_[i];
    entry.options = options_;
    if (margin_is_required_) entry.options.margin *= kMoreThanRequired;
    entry.options.time_limit -= stopwatch_.Seconds();
    if (entry.options.time_limit <= 0.0) {
      if (i > 0) return false;
      entry.options.time_limit = options_.time_limit;
    }
    if (options_.is_interrupted) {
      entry.options.is_interrupted = [this] {
        const std::lock_guard<std::mutex> lock(asking_);
        return options_.is_interrupted();
      };
    }
    entry.is_tried = true;
    return true;
  }

  // These return which paths came to their end.
  std::vector<std::size_t> OptimizeFirst(std::size_t count) {
    std::vector<std::size_t> first(std::min(count, paths_.size()));
    std::iota(first.begin(), first.end(), std::size_t{0});
    tbb::parallel_for(std::size_t{0}, first.size(), [&](std::size_t i) {
      if (!Enter(i)) return;
      entries_[i].found =
          OptimizeCurve(space_, diagonal_, paths_[i], entries_[i].options);
    });
    return first;
  }

  void Begin(std::size_t i) {
    if (!Enter(i)) return;
    Entry& entry = entries_[i];
    RequireCurve(diagonal_, paths_[i], entry.options);
    entry.search =
        std::make_unique<CurveSearch>(space_, diagonal_, entry.options);
    entry.search->Begin(paths_[i]);
    entry.found = entry.search->Summary();
  }

  bool IsAnotherWay(std::size_t i, const std::vector<std::size_t>& than) const {
    return std::none_of(than.begin(), than.end(), [&](std::size_t k) {
      return IsNear(paths_[i], paths_[k], kAlike * diagonal_) &&
             IsNear(paths_[k], paths_[i], kAlike * diagonal_);
    });
  }

  // Could it be better than what the first path has come to?
  bool IsShortEnough(std::size_t i) const {
    return FastestAlong(paths_[i], options_.limits) < CostOfFirst();
  }

  double CostOfFirst() const {
    const CurveSummary& first = entries_[0].found;
    return first.trajectory.empty() ? std::numeric_limits<double>::infinity()
                                    : first.cost;
  }

  // The less, the better what it has come to.
  std::pair<bool, double> PlaceOf(std::size_t i) const {
    const CurveSummary& found = entries_[i].found;
    return {found.trajectory.empty(), found.cost};
  }

  // Wherever it goes, as far as limits know.
  double LeastOfAll() const {
    return LeastDuration(paths_[0].back() - paths_[0].front(), options_.limits,
                         options_.start.IsAtRest() && options_.end.IsAtRest());
  }

  std::vector<std::size_t> RefineBest(std::size_t refined) {
    Begin(0);
    std::vector<std::size_t> order = {0};
    const bool is_good = CostOfFirst() <= kNearLeast * LeastOfAll();
    for (std::size_t i = 1; i < paths_.size(); ++i) {
      const bool may_win = !is_good && paths_[i].size() <= kMostCorners &&
                           IsAnotherWay(i, order) && IsShortEnough(i);
      if (refined > 1 || may_win) order.push_back(i);
    }
    tbb::parallel_for(std::size_t{1}, order.size(),
                      [&](std::size_t k) { Begin(order[k]); });
    std::stable_sort(order.begin(), order.end(),
                     [this](std::size_t a, std::size_t b) {
                       return PlaceOf(a) < PlaceOf(b);
                     });
    order.resize(std::min(order.size(), refined));
    tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {
      Entry& entry = entries_[order[k]];
      if (!entry.search) return;
      entry.search->Refine();
      entry.found = entry.search->Summary();
    });
    return order;
  }

  const Stopwatch stopwatch_;
  const FreeSpace& space_;
  const double diagonal_;
  const std::vector<Path>& paths_;
  const CurveOptions& options_;
  const bool margin_is_required_;
  std::mutex asking_;
  std::vector<Entry> entries_;
};

}  // namespace

double SquaredJerk(const Trajectory& trajectory, const MotionLimits& limits) {
  // Gauss's three points: exact for the square of a parabola.
  const double off = 0.5 * std::sqrt(0.6);
  const std::array<std::pair<double, double>, 3> rule = {
      {{0.5 - off, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + off, 5.0 / 18.0}}};
  const Vector3d limit =
      limits.by_norm ? Vector3d::Constant(limits.jerk[0]) : limits.jerk;
  double sum = 0.0;
  for (const CurvePiece& piece : trajectory.pieces()) {
    const CurvePiece jerk = piece.Derivative().Derivative().Derivative();
    for (const auto& [s, weight] : rule) {
      const Vector3d share = jerk.At(s).cwiseQuotient(limit);
      sum += weight * piece.duration() * share.squaredNorm();
    }
  }
  return sum;
}

BestCurve OptimizeAlongBest(const FreeSpace& space, double diagonal,
                            const std::vector<Path>& paths,
                            const CurveOptions& options,
                            bool margin_is_required, int refined) {
  return Contest(space, diagonal, paths, options, margin_is_required)
      .Run(static_cast<std::size_t>(refined));
}

}  // namespace phongpd::internal
