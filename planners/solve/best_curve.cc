// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/best_curve.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <mutex>
#include <utility>

#include "core/stopwatch.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// The share of the margin that counts as all of it: of a wish as of polylines
// (kToleratedMissing), of what is required but for rounding.
constexpr double kWished = 0.9, kRequired = 1.0 - 1e-6;

bool IsBetterCurve(const CurveSummary& a, const CurveSummary& b,
                   const CurveOptions& options, double kept_share) {
  if (a.trajectory.empty() || b.trajectory.empty()) {
    // The least duration that is known counts where none is short enough.
    return !a.trajectory.empty() ||
           (b.trajectory.empty() && a.duration < b.duration);
  }
  const bool a_keeps = a.margin >= kept_share * options.margin;
  const bool b_keeps = b.margin >= kept_share * options.margin;
  if (a_keeps != b_keeps) return a_keeps;
  if (options.duration > 0.0) {
    return SquaredJerk(a.trajectory, options.limits) <
           SquaredJerk(b.trajectory, options.limits);
  }
  return a.duration < b.duration;
}

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
                            bool margin_is_required) {
  const Stopwatch stopwatch;
  const double kept_share = margin_is_required ? kRequired : kWished;
  std::mutex asking;
  std::vector<CurveSummary> found(paths.size());
  std::vector<char> is_tried(paths.size(), 0);
  tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
    CurveOptions own = options;
    own.time_limit = options.time_limit - stopwatch.Seconds();
    if (own.time_limit <= 0.0) {
      if (i > 0) return;
      own.time_limit = options.time_limit;
    }
    if (options.is_interrupted) {
      own.is_interrupted = [&] {
        const std::lock_guard<std::mutex> lock(asking);
        return options.is_interrupted();
      };
    }
    is_tried[i] = 1;
    found[i] = OptimizeCurve(space, diagonal, paths[i], own);
  });
  BestCurve best;
  best.tried = 1;
  for (std::size_t i = 1; i < found.size(); ++i) {
    if (is_tried[i] == 0) continue;
    ++best.tried;
    if (found[i].status == PathStatus::kNotFree) continue;
    if (IsBetterCurve(found[i], found[best.path], options, kept_share)) {
      best.path = i;
    }
  }
  for (const CurveSummary& one : found) best.motions.push_back(one.trajectory);
  best.summary = std::move(found[best.path]);
  best.summary.seconds = stopwatch.Seconds();
  return best;
}

}  // namespace phongpd::internal
