// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_optimizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "constraints/curve_judge.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/stopwatch.h"
#include "planners/exact/check_option.h"
#include "planners/trajectory/curve_cells.h"
#include "planners/trajectory/curve_ends.h"
#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/curve_rests.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::CurveStep;
using internal::KnotCurve;
using internal::PieceCells;
using internal::ViaKnot;
using Path = std::vector<Vector3d>;

constexpr double kTrust = 0.05;  // τ, of D
constexpr double kSigma = 0.03;  // σ of the first round
constexpr double kLargestSigma = 0.5;
constexpr double kGoodStep = 0.5;  // a smaller share of what was predicted asks
                                   // for a shorter step
constexpr double kSmallestSigma = 1e-5;
constexpr int kPieces = 3;      // of a segment of the path
constexpr int kMaxRounds = 60;  // of a size of pieces
// So many rounds in a row that gain less, a share of the time, end it.
constexpr int kSmallGains = 2;
constexpr double kSmallGain = 1e-3;
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

double MissingOf(const std::vector<PieceCells>& cells, double margin) {
  double missing = 0.0;
  for (const PieceCells& of_piece : cells) {
    missing += std::max(0.0, margin - of_piece.distance);
  }
  return missing;
}

// So much of a step.
KnotCurve Moved(const KnotCurve& curve, const KnotCurve& change, double share) {
  KnotCurve moved = curve;
  for (std::size_t k = 0; k < curve.knots.size(); ++k) {
    moved.knots[k].p += share * change.knots[k].p;
    moved.knots[k].v += share * change.knots[k].v;
    moved.knots[k].a += share * change.knots[k].a;
  }
  for (std::size_t i = 0; i < curve.durations.size(); ++i) {
    moved.durations[i] *= std::exp(share * change.durations[i]);
  }
  return moved;
}

// The least time at which it keeps the limits, proved; not slowed by more than
// rounding if it has an end in motion.
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

class Optimizer {
 public:
  Optimizer(const FreeSpace& space, double diagonal,
            const CurveOptions& options)
      : space_(space), options_(options), diagonal_(diagonal) {
    settings_.limits = options.limits;
    settings_.diagonal = diagonal;
    settings_.margin = options.margin;
    settings_.trust = kTrust * diagonal;
    settings_.sigma = kSigma;
    settings_.keeps_pace = !options.start.IsAtRest() || !options.end.IsAtRest();
  }

  CurveSummary Run(const Path& path) {
    if (CheckPath(space_, path).free) Start(path);
    if (!summary_.trajectory.empty()) {
      const int halvings = static_cast<int>(options_.preset);
      for (int i = 0; i <= halvings; ++i) {
        if (i > 0 && !Halve()) break;
        if (!RunRounds()) break;
        if (!IsFastEnough()) continue;
        KeepDuration();
        if (!RunRounds()) break;
      }
      Report();
    }
    summary_.seconds = stopwatch_.Seconds();
    return summary_;
  }

 private:
  // The path from place to place.
  std::vector<Path> LegsOf(const Path& path) const {
    std::vector<Path> legs;
    auto from = path.begin();
    for (const CurveVia& via : options_.via) {
      const auto to = std::find(from, path.end(), via.point);
      legs.emplace_back(from, to + 1);
      from = to;
    }
    legs.emplace_back(from, path.end());
    return legs;
  }

  // Stops at the corners of all legs, and the knots at which they meet.
  KnotCurve StopOnLegs(const std::vector<Path>& legs, int first_knot) {
    KnotCurve all;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      auto corners = internal::DropCorners(space_, legs[i], options_.margin);
      if (corners.size() < 2) corners = legs[i];
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      if (corners.size() > 1) {
        all = internal::Joined(
            all, internal::StopAtCorners(corners, options_.limits, kPieces));
      }
      if (i < options_.via.size()) {
        const CurveVia& via = options_.via[i];
        settings_.via.push_back(
            {first_knot + all.pieces(), via.point, via.tolerance});
      }
    }
    return all;
  }

  // Without those that are an end of the curve: they stay where they are.
  static std::vector<ViaKnot> InnerKnots(std::vector<ViaKnot> via,
                                         int first_knot, int pieces) {
    for (ViaKnot& one : via) one.knot -= first_knot;
    via.erase(std::remove_if(via.begin(), via.end(),
                             [&](const ViaKnot& one) {
                               return one.knot == 0 || one.knot == pieces;
                             }),
              via.end());
    return via;
  }

  // A stop from the start, stops at the path's corners, and a run-up to the
  // end.
  void Start(const Path& path) {
    const MotionLimits& limits = options_.limits;
    const KnotCurve::State first = {path.front(), options_.start.velocity,
                                    options_.start.acceleration};
    const KnotCurve::State last = {path.back(), -options_.end.velocity,
                                   options_.end.acceleration};
    std::vector<Path> legs = LegsOf(path);
    const internal::Stop begin = internal::FindStop(
        space_, diagonal_, first, legs.front(), limits, false);
    legs.front() = begin.path;
    std::reverse(legs.back().begin(), legs.back().end());
    const internal::Stop end =
        internal::FindStop(space_, diagonal_, last, legs.back(), limits, true);
    legs.back() = end.path;
    std::reverse(legs.back().begin(), legs.back().end());
    const int first_knot = begin.curve.pieces();
    const KnotCurve stops = StopOnLegs(legs, first_knot);
    const auto join = [&](const KnotCurve& middle) {
      return internal::Joined(internal::Joined(begin.curve, middle),
                              internal::Backwards(end.curve));
    };
    now_ = join(stops);
    settings_.via = InnerKnots(settings_.via, 0, now_.pieces());
    // On the path but for rounding, by which it may still touch.
    if (!Keep(now_)) return;
    summary_.stops_duration = summary_.duration;
    summary_.first_seconds = stopwatch_.Seconds();
    if (!settings_.keeps_pace || stops.knots.empty()) return;
    // What begins and ends at rest takes longer steps.
    KnotCurve faster = join(OptimizedFromRest(stops, first_knot));
    if (Keep(faster)) now_ = std::move(faster);
  }

  KnotCurve OptimizedFromRest(const KnotCurve& stops, int first_knot) const {
    CurveOptions options = options_;
    options.start = options.end = {};
    options.time_limit -= stopwatch_.Seconds();
    Optimizer optimizer(space_, diagonal_, options);
    optimizer.now_ = stops;
    optimizer.settings_.via =
        InnerKnots(settings_.via, first_knot, stops.pieces());
    optimizer.RunRounds();
    return optimizer.now_;
  }

  // Becomes the answer if it passes its places, is free and within the limits,
  // both proved.
  bool Keep(const KnotCurve& curve) {
    for (const ViaKnot& via : settings_.via) {
      if (!((curve.knots[via.knot].p - via.point).norm() <= via.tolerance)) {
        return false;
      }
    }
    Trajectory fitted = curve.ToTrajectory();
    if (!CheckCurve(space_, fitted).IsFree()) return false;
    // Other durations, the same points.
    if (!FitTime(options_.limits, !settings_.keeps_pace, &fitted)) return false;
    summary_.trajectory = std::move(fitted);
    summary_.duration = summary_.trajectory.duration();
    return true;
  }

  bool MustEnd() {
    const bool is_interrupted =
        options_.is_interrupted && options_.is_interrupted();
    if (is_interrupted) summary_.status = PathStatus::kInterrupted;
    const bool is_late = stopwatch_.Seconds() > options_.time_limit;
    if (is_late && !is_interrupted) summary_.status = PathStatus::kTimeLimit;
    return is_interrupted || is_late;
  }

  std::vector<PieceCells> CellsOf(const KnotCurve& curve) const {
    std::vector<PieceCells> cells;
    for (int i = 0; i < curve.pieces(); ++i) {
      cells.push_back(internal::FindCells(space_, curve.PointsOf(i),
                                          settings_.trust, options_.margin));
    }
    return cells;
  }

  double MeritOf(const KnotCurve& curve,
                 const std::vector<PieceCells>& cells) const {
    return options_.margin > 0.0
               ? settings_.weights.missing * MissingOf(cells, options_.margin) /
                     (diagonal_ * curve.pieces())
               : 0.0;
  }

  // False if it must end.
  bool RunRounds() {
    cells_ = CellsOf(now_);
    int small_gains = 0;
    for (int i = 0; i < kMaxRounds; ++i) {
      if (IsFastEnough()) break;
      if (MustEnd()) return false;
      const double gain = is_calm_ ? RunCalmRound() : RunRound();
      small_gains = gain < kSmallGain ? small_gains + 1 : 0;
      if (small_gains >= kSmallGains || settings_.sigma < kSmallestSigma) {
        summary_.status = PathStatus::kConverged;
        return true;
      }
    }
    summary_.status = PathStatus::kRoundLimit;
    return true;
  }

  bool IsFastEnough() const {
    return !is_calm_ && options_.duration > 0.0 &&
           now_.Duration() <= options_.duration;
  }

  // From now on the curve takes the time asked for.
  void KeepDuration() {
    now_.Slow(options_.duration / now_.Duration());
    is_calm_ = settings_.keeps_pace = true;
    settings_.sigma = kSigma;
    settings_.jerk_scale = internal::JerkScale(now_, options_.limits);
    Keep(now_);
  }

  // What the mean of the squared jerk fell by, a share.
  double RunCalmRound() {
    CurveRound round;
    round.sigma = settings_.sigma;
    round.pieces = now_.pieces();
    for (const PieceCells& cells : cells_) round.planes += cells.planes;
    const auto jerk_of = [&](const KnotCurve& curve) {
      return internal::MeanSquaredJerk(curve, settings_.jerk_scale);
    };
    // It is as T⁻⁶ of the same way: so neither longer nor shorter is better.
    const double before = jerk_of(now_);
    settings_.weights.jerk = 1.0 / (6.0 * before);
    const CurveStep step = internal::SolveCurveProgram(now_, cells_, settings_);
    round.rows = step.rows;
    round.iterations = step.iterations;
    double share = 1.0;
    for (int i = 0; i <= kShorterSteps && !round.is_accepted; ++i) {
      if (i > 0) share *= 0.5;
      KnotCurve moved = Moved(now_, step.change, share);
      moved.Slow(options_.duration / moved.Duration());
      round.gain = 1.0 - jerk_of(moved) / before;
      if (!(round.gain > 0.0) ||
          internal::SlowingOf(moved, options_.limits) > 1.0 || !Keep(moved)) {
        continue;
      }
      round.is_accepted = true;
      now_ = std::move(moved);
      cells_ = CellsOf(now_);
    }
    settings_.sigma *= !round.is_accepted ? 0.3 : share < 1.0 ? share : 2.0;
    settings_.sigma = std::min(settings_.sigma, kLargestSigma);
    round.duration = now_.Duration();
    summary_.rounds.push_back(round);
    return round.is_accepted ? round.gain : kSmallGain;
  }

  // So much of a step, slowed so that the limits hold; where the pace is kept,
  // so much that they do, or nothing.
  KnotCurve WithinLimits(const KnotCurve& change, double share) const {
    KnotCurve moved = Moved(now_, change, share);
    if (!settings_.keeps_pace) {
      moved.Slow(internal::SlowingOf(moved, options_.limits));
      return moved;
    }
    for (int i = 0; i <= kShorterSteps; ++i, share *= 0.5) {
      moved = Moved(now_, change, share);
      internal::CurveProgramOptions correction = settings_;
      correction.spare = kSpare;
      for (const double sigma : kCorrections) {
        if (internal::SlowingOf(moved, options_.limits) <= 1.0) return moved;
        correction.sigma = std::min(sigma, settings_.sigma);
        const CurveStep step =
            internal::SolveCurveProgram(moved, CellsOf(moved), correction);
        moved = Moved(moved, step.change, 1.0);
      }
      if (internal::SlowingOf(moved, options_.limits) <= 1.0) return moved;
    }
    return now_;
  }

  double GainOf(const KnotCurve& curve) const {
    return 1.0 - curve.Duration() / now_.Duration();
  }

  // What the merit fell by, a share of the time; or should have fallen by, if
  // the step is not taken.
  double RunRound() {
    CurveRound round;
    round.sigma = settings_.sigma;
    round.pieces = now_.pieces();
    for (const PieceCells& cells : cells_) round.planes += cells.planes;
    const CurveStep step = internal::SolveCurveProgram(now_, cells_, settings_);
    round.rows = step.rows;
    round.iterations = step.iterations;
    round.predicted = step.predicted;
    KnotCurve moved = WithinLimits(step.change, 1.0);
    double gain = GainOf(moved);
    // A step that only restores clearance is as good as any.
    const double ratio =
        step.predicted > 0.0 ? gain / step.predicted : kGoodStep;
    if (ratio < kGoodStep) {
      // gain(x) = predicted · x − (predicted − gain) x² is largest there.
      const double share = 0.5 / (1.0 - ratio);
      KnotCurve less = WithinLimits(step.change, share);
      if (GainOf(less) > gain) {
        moved = std::move(less);
        gain = GainOf(moved);
      }
    }
    std::vector<PieceCells> cells;
    bool is_better = options_.margin > 0.0 || gain > 0.0;
    if (is_better && options_.margin > 0.0) {
      cells = CellsOf(moved);
      gain += MeritOf(now_, cells_) - MeritOf(moved, cells);
      is_better = gain > 0.0;
    }
    round.is_accepted = is_better && Keep(moved);
    if (round.is_accepted) {
      now_ = std::move(moved);
      cells_ = options_.margin > 0.0 ? std::move(cells) : CellsOf(now_);
    }
    ChangeSigma(round.is_accepted ? ratio : -1.0);
    round.duration = now_.Duration();
    round.gain = gain;
    summary_.rounds.push_back(round);
    return round.is_accepted ? gain : step.predicted;
  }

  // By the share of what was predicted that came true.
  void ChangeSigma(double ratio) {
    if (ratio < 0.0) {
      settings_.sigma *= 0.3;
    } else if (ratio < 0.3) {
      settings_.sigma *= 0.5;
    } else if (ratio > 0.7) {
      settings_.sigma = std::min(2.0 * settings_.sigma, kLargestSigma);
    }
  }

  bool Halve() {
    KnotCurve halved = now_.Halved();
    if (!settings_.keeps_pace) {
      halved.Slow(internal::SlowingOf(halved, options_.limits));
    }
    for (ViaKnot& via : settings_.via) via.knot *= 2;
    if (!Keep(halved)) return false;
    now_ = std::move(halved);
    return true;
  }

  // Cells know all that is within their reach.
  void Report() {
    if (options_.duration > 0.0 && !is_calm_) {
      summary_.status = PathStatus::kDurationTooShort;
      summary_.trajectory = Trajectory();
      return;
    }
    const double reach = settings_.trust + options_.margin;
    double clearance = std::numeric_limits<double>::infinity();
    for (const CurvePiece& piece : summary_.trajectory.pieces()) {
      KnotCurve::Points points;
      for (int j = 0; j < 6; ++j) points.col(j) = piece.point(j);
      const PieceCells cells =
          internal::FindCells(space_, points, settings_.trust, options_.margin);
      const double by_chord =
          space_.Clearance(piece.front(), piece.back()) - piece.Bend();
      clearance = std::min(clearance,
                           std::max(by_chord, std::min(cells.distance, reach)));
    }
    summary_.clearance = clearance;
    summary_.margin = std::min(options_.margin, clearance);
  }

  const Stopwatch stopwatch_;
  const FreeSpace& space_;
  const CurveOptions& options_;
  const double diagonal_;
  internal::CurveProgramOptions settings_;
  bool is_calm_ = false;  // of the duration asked for
  KnotCurve now_;
  std::vector<PieceCells> cells_;
  CurveSummary summary_;
};

}  // namespace

CurveSummary OptimizeCurve(const FreeSpace& space, double diagonal,
                           const std::vector<Vector3d>& free_path,
                           const CurveOptions& options) {
  options.Validate();
  CheckOption(diagonal > 0.0 && std::isfinite(diagonal), "curve", "diagonal",
              "a finite length > 0", diagonal);
  if (!std::all_of(free_path.begin(), free_path.end(), IsFinite)) {
    throw InputError("path: expected finite points, found NaN or Inf");
  }
  if (std::all_of(free_path.begin(), free_path.end(),
                  [&](const Vector3d& q) { return q == free_path[0]; })) {
    throw InputError("path: expected two different points at least, found " +
                     std::string(free_path.empty() ? "none" : "one"));
  }
  auto at = free_path.begin();
  for (std::size_t i = 0; i < options.via.size(); ++i) {
    at = std::find(at, free_path.end(), options.via[i].point);
    if (at != free_path.end()) continue;
    throw InputError("curve: via " + std::to_string(i) +
                     ": expected a point of the path, in order, found (" +
                     FormatPoint(options.via[i].point) + ")");
  }
  const bool rests =
      std::any_of(options.via.begin(), options.via.end(),
                  [](const CurveVia& via) { return via.dwell > 0.0; });
  return rests
             ? internal::OptimizeWithRests(space, diagonal, free_path, options)
             : Optimizer(space, diagonal, options).Run(free_path);
}

}  // namespace phongpd
