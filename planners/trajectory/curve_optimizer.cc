// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_optimizer.h"

#include <algorithm>
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
#include "planners/trajectory/curve_limits.h"
#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/curve_rests.h"
#include "planners/trajectory/curve_start.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::CurveStart;
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
constexpr int kMaxRounds = 60;  // of a size of pieces
// So many rounds in a row that gain less, a share of the time, end it.
constexpr int kSmallGains = 2;
constexpr double kSmallGain = 1e-3;
constexpr int kStepHalvings = 3;  // of a step that is not taken

double MissingOf(const std::vector<PieceCells>& cells, double margin) {
  double missing = 0.0;
  for (const PieceCells& of_piece : cells) {
    missing += std::max(0.0, margin - of_piece.distance);
  }
  return missing;
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
  void Start(const Path& path) {
    const CurveStart start =
        internal::FindCurveStart(space_, diagonal_, path, options_);
    now_ = start.With(start.stops);
    settings_.via = start.via;
    // On the path but for rounding, by which it may still touch.
    if (!Keep(now_)) return;
    summary_.stops_duration = summary_.duration;
    summary_.first_seconds = stopwatch_.Seconds();
    if (!settings_.keeps_pace || start.stops.knots.empty()) return;
    // What begins and ends at rest takes longer steps.
    KnotCurve faster = start.With(OptimizedFromRest(start));
    if (Keep(faster)) now_ = std::move(faster);
  }

  KnotCurve OptimizedFromRest(const CurveStart& start) const {
    CurveOptions options = options_;
    options.start = options.end = {};
    options.time_limit -= stopwatch_.Seconds();
    Optimizer optimizer(space_, diagonal_, options);
    optimizer.now_ = start.stops;
    optimizer.settings_.via = start.ViaOfStops();
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
    if (!internal::FitTime(options_.limits, !settings_.keeps_pace, &fitted)) {
      return false;
    }
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

  double MeritOf(const KnotCurve& curve,
                 const std::vector<PieceCells>& cells) const {
    return options_.margin > 0.0
               ? settings_.weights.missing * MissingOf(cells, options_.margin) /
                     (diagonal_ * curve.pieces())
               : 0.0;
  }

  // False if it must end.
  bool RunRounds() {
    cells_ = internal::CellsOf(space_, now_, settings_);
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
    for (int i = 0; i <= kStepHalvings && !round.is_accepted; ++i) {
      if (i > 0) share *= 0.5;
      KnotCurve moved = internal::Moved(now_, step.change, share);
      moved.Slow(options_.duration / moved.Duration());
      round.gain = 1.0 - jerk_of(moved) / before;
      if (!(round.gain > 0.0) ||
          internal::SlowingOf(moved, options_.limits) > 1.0 || !Keep(moved)) {
        continue;
      }
      round.is_accepted = true;
      now_ = std::move(moved);
      cells_ = internal::CellsOf(space_, now_, settings_);
    }
    settings_.sigma *= !round.is_accepted ? 0.3 : share < 1.0 ? share : 2.0;
    settings_.sigma = std::min(settings_.sigma, kLargestSigma);
    round.duration = now_.Duration();
    summary_.rounds.push_back(round);
    return round.is_accepted ? round.gain : kSmallGain;
  }

  KnotCurve Moved(const KnotCurve& change, double share) const {
    return internal::MovedWithinLimits(space_, now_, change, share, settings_);
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
    KnotCurve moved = Moved(step.change, 1.0);
    double gain = GainOf(moved);
    // A step that only restores clearance is as good as any.
    const double ratio =
        step.predicted > 0.0 ? gain / step.predicted : kGoodStep;
    if (ratio < kGoodStep) {
      // gain(x) = predicted · x − (predicted − gain) x² is largest there.
      const double share = 0.5 / (1.0 - ratio);
      KnotCurve less = Moved(step.change, share);
      if (GainOf(less) > gain) {
        moved = std::move(less);
        gain = GainOf(moved);
      }
    }
    std::vector<PieceCells> cells;
    bool is_better = options_.margin > 0.0 || gain > 0.0;
    if (is_better && options_.margin > 0.0) {
      cells = internal::CellsOf(space_, moved, settings_);
      gain += MeritOf(now_, cells_) - MeritOf(moved, cells);
      is_better = gain > 0.0;
    }
    round.is_accepted = is_better && Keep(moved);
    if (round.is_accepted) {
      now_ = std::move(moved);
      cells_ = options_.margin > 0.0
                   ? std::move(cells)
                   : internal::CellsOf(space_, now_, settings_);
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
