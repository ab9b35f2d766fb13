// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace phongpd::internal {
namespace {

// What rounding may leave above a limit is scaled away.
constexpr double kAboveLimit = 0x1p-48;
constexpr double kMoreAbove = 8.0;  // by each further scaling
constexpr int kScalings = 8;
// Of ends in motion the velocity is what was asked for but for this share.
constexpr double kSlowedAtEnds = 1e-11;
// A step that passes the limits is corrected where it leads, durations changing
// by less each time, ln, and with some room below the limits for what that
// neglects.  Where it fails the step is halved so often.
constexpr std::array<double, 3> kCorrections = {1e-2, 1e-3, 1e-4};
constexpr double kSpare = 2e-4;
constexpr int kShorterSteps = 3;

}  // namespace

KnotCurve Moved(const KnotCurve& curve, const KnotCurve& change, double share) {
  KnotCurve moved = curve;
  const std::size_t last = curve.durations.size();
  for (std::size_t k = 0; k <= last; ++k) {
    const KnotCurve::State& by = change.knots[k];
    const bool is_end = k == 0 || k == last;
    const double gamma =
        is_end ? 0.0
               : 0.5 * share * (change.durations[k - 1] + change.durations[k]);
    const double pace = std::exp(-gamma);
    KnotCurve::State& state = moved.knots[k];
    state.p += share * by.p;
    state.v = pace * ((1.0 + gamma) * state.v + share * by.v);
    state.a = pace * pace * ((1.0 + 2.0 * gamma) * state.a + share * by.a);
  }
  for (std::size_t i = 0; i < last; ++i) {
    moved.durations[i] *= std::exp(share * change.durations[i]);
  }
  return moved;
}

std::vector<PieceCells> CellsOf(const FreeSpace& space, const KnotCurve& curve,
                                const CurveProgramOptions& options) {
  std::vector<PieceCells> cells;
  for (int i = 0; i < curve.pieces(); ++i) {
    cells.push_back(
        FindCells(space, curve.PointsOf(i), options.trust, options.margin));
  }
  return cells;
}

KnotCurve MovedWithinLimits(const FreeSpace& space, const KnotCurve& now,
                            const KnotCurve& change, double share,
                            const CurveProgramOptions& options) {
  KnotCurve moved = Moved(now, change, share);
  if (!options.keeps_pace) {
    moved.Slow(SlowingOf(moved, options.limits));
    return moved;
  }
  for (int i = 0; i <= kShorterSteps; ++i, share *= 0.5) {
    moved = Moved(now, change, share);
    CurveProgramOptions correction = options;
    correction.spare = kSpare;
    for (const double sigma : kCorrections) {
      if (SlowingOf(moved, options.limits) <= 1.0) return moved;
      correction.sigma = std::min(sigma, options.sigma);
      const CurveStep step = SolveCurveProgram(
          moved, CellsOf(space, moved, correction), correction);
      moved = Moved(moved, step.change, 1.0);
    }
    if (SlowingOf(moved, options.limits) <= 1.0) return moved;
  }
  return now;
}

bool FitTime(const MotionLimits& limits, bool is_at_rest,
             Trajectory* trajectory) {
  double rounding = kAboveLimit;
  for (int i = 0; i < kScalings; ++i, rounding *= kMoreAbove) {
    const LimitUse use = BoundLimitUse(*trajectory, limits);
    if (use.IsKept() && (i > 0 || !is_at_rest)) return true;
    const double slowing = use.SlowingNeeded() * (1.0 + rounding);
    if (!is_at_rest && slowing > 1.0 + kSlowedAtEnds) return false;
    *trajectory = trajectory->Slowed(slowing);
  }
  return false;
}

}  // namespace phongpd::internal
