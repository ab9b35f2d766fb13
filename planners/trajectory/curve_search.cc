// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "constraints/curve_judge.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/exact/check_option.h"
#include "planners/trajectory/curve_limits.h"
#include "planners/trajectory/curve_start.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

double MissingOf(const std::vector<PieceCells>& cells, double margin) {
  double missing = 0.0;
  for (const PieceCells& of_piece : cells) {
    missing += std::max(0.0, margin - of_piece.distance);
  }
  return missing;
}

}  // namespace

CurveSearch::CurveSearch(const FreeSpace& space, double diagonal,
                         const CurveOptions& options)
    : space_(space), options_(options), diagonal_(diagonal) {
  settings_.limits = options.limits;
  settings_.diagonal = diagonal;
  settings_.margin = options.margin;
  settings_.weights.missing = options.margin_price;
  settings_.trust = kTrust * diagonal;
  settings_.sigma = kSigma;
  settings_.keeps_pace = !options.start.IsAtRest() || !options.end.IsAtRest();
}

void CurveSearch::Begin(const Path& path) {
  if (CheckPath(space_, path).free) Start(path);
  if (!summary_.trajectory.empty()) goes_on_ = RunStage();
  if (goes_on_ && now_.pieces() < kFewest) goes_on_ = Halve() && RunStage();
}

void CurveSearch::Refine() {
  const int halvings = static_cast<int>(options_.preset);
  for (int i = 0; i < halvings && goes_on_; ++i) {
    goes_on_ = Halve() && RunStage();
  }
  if (goes_on_ && now_.pieces() < halvings * kFewPieces) {
    goes_on_ = Halve() && RunStage();
  }
  while (goes_on_ && now_.pieces() < halvings * kLeastPieces) {
    goes_on_ = Halve() && RunStage();
  }
}

CurveSummary CurveSearch::Summary() const {
  CurveSummary summary = summary_;
  if (!is_fitted_) Fit(&summary);
  if (options_.duration > 0.0 && !is_calm_ && !summary.trajectory.empty()) {
    summary.status = PathStatus::kDurationTooShort;
    summary.trajectory = Trajectory();
  }
  if (!summary.trajectory.empty()) Measure(&summary);
  summary.seconds = stopwatch_.Seconds();
  return summary;
}

void CurveSearch::Start(const Path& path) {
  const CurveStart start = FindCurveStart(space_, diagonal_, path, options_);
  now_ = start.With(start.stops);
  settings_.via = start.via;
  // On the path but for rounding, by which it may still touch.
  if (!Keep(now_)) return;
  if (!is_fitted_) Fit(&summary_);
  is_fitted_ = true;
  if (summary_.trajectory.empty()) return;
  summary_.stops_duration = summary_.duration;
  summary_.first_seconds = stopwatch_.Seconds();
  if (!settings_.keeps_pace || start.stops.knots.empty()) return;
  // What begins and ends at rest takes longer steps.
  KnotCurve faster = start.With(OptimizedFromRest(start));
  if (Keep(faster)) now_ = std::move(faster);
}

KnotCurve CurveSearch::OptimizedFromRest(const CurveStart& start) const {
  CurveOptions options = options_;
  options.start = options.end = {};
  options.time_limit -= stopwatch_.Seconds();
  CurveSearch search(space_, diagonal_, options);
  search.now_ = start.stops;
  search.settings_.via = start.ViaOfStops();
  search.RunRounds();
  return search.now_;
}

bool CurveSearch::Keep(const KnotCurve& curve) {
  for (const ViaKnot& via : settings_.via) {
    if (!((curve.knots[via.knot].p - via.point).norm() <= via.tolerance)) {
      return false;
    }
  }
  Trajectory kept = curve.ToTrajectory();
  if (!CheckCurve(space_, kept).IsFree()) return false;
  if (settings_.keeps_pace && !FitTime(options_.limits, false, &kept)) {
    return false;
  }
  is_fitted_ = settings_.keeps_pace;
  summary_.trajectory = std::move(kept);
  summary_.duration = summary_.trajectory.duration();
  return true;
}

void CurveSearch::Fit(CurveSummary* summary) const {
  // Other durations, the same points.
  if (!FitTime(options_.limits, true, &summary->trajectory)) {
    summary->trajectory = Trajectory();
    summary->status = PathStatus::kNotFree;
  }
  summary->duration = summary->trajectory.duration();
}

bool CurveSearch::MustEnd() {
  const bool is_interrupted =
      options_.is_interrupted && options_.is_interrupted();
  if (is_interrupted) summary_.status = PathStatus::kInterrupted;
  const bool is_late = stopwatch_.Seconds() > options_.time_limit;
  if (is_late && !is_interrupted) summary_.status = PathStatus::kTimeLimit;
  return is_interrupted || is_late;
}

double CurveSearch::PriceOf(double missing, int pieces) const {
  return settings_.weights.missing * missing / (diagonal_ * pieces);
}

double CurveSearch::MeritOf(const KnotCurve& curve,
                            const std::vector<PieceCells>& cells) const {
  return PriceOf(MissingOf(cells, options_.margin), curve.pieces());
}

bool CurveSearch::RunStage() {
  if (!RunRounds()) return false;
  if (!IsFastEnough()) return true;
  KeepDuration();
  return RunRounds();
}

bool CurveSearch::RunRounds() {
  cells_ = CellsOf(space_, now_, settings_);
  for (int i = 0; i < kMaxRounds; ++i) {
    if (IsFastEnough()) break;
    if (MustEnd()) return false;
    const double gain = is_calm_ ? RunCalmRound() : RunRound();
    if (gain < kSmallGain || settings_.sigma < kSmallestSigma) {
      summary_.status = PathStatus::kConverged;
      return true;
    }
  }
  summary_.status = PathStatus::kRoundLimit;
  return true;
}

bool CurveSearch::IsFastEnough() const {
  return !is_calm_ && options_.duration > 0.0 &&
         now_.Duration() <= options_.duration;
}

void CurveSearch::KeepDuration() {
  now_.Slow(options_.duration / now_.Duration());
  is_calm_ = settings_.keeps_pace = true;
  settings_.sigma = kSigma;
  settings_.jerk_scale = JerkScale(now_, options_.limits);
  settings_.caution.clear();
  Keep(now_);
}

double CurveSearch::RunCalmRound() {
  CurveRound round;
  round.sigma = settings_.sigma;
  round.pieces = now_.pieces();
  for (const PieceCells& cells : cells_) round.planes += cells.planes;
  const auto jerk_of = [&](const KnotCurve& curve) {
    return MeanSquaredJerk(curve, settings_.jerk_scale);
  };
  // It is as T⁻⁶ of the same way: so neither longer nor shorter is better.
  const double before = jerk_of(now_);
  settings_.weights.jerk = 1.0 / (6.0 * before);
  const CurveStep step = SolveCurveProgram(now_, cells_, settings_);
  round.rows = step.rows;
  round.iterations = step.iterations;
  double share = 1.0;
  for (int i = 0; i <= kStepHalvings && !round.is_accepted; ++i) {
    if (i > 0) share *= 0.5;
    KnotCurve moved = Moved(now_, step.change, share);
    moved.Slow(options_.duration / moved.Duration());
    round.gain = 1.0 - jerk_of(moved) / before;
    if (!(round.gain > 0.0) || SlowingOf(moved, options_.limits) > 1.0 ||
        !Keep(moved)) {
      continue;
    }
    round.is_accepted = true;
    now_ = std::move(moved);
    cells_ = CellsOf(space_, now_, settings_);
  }
  settings_.sigma *= !round.is_accepted ? 0.3 : share < 1.0 ? share : 2.0;
  settings_.sigma = std::min(settings_.sigma, kLargestSigma);
  round.duration = now_.Duration();
  summary_.rounds.push_back(round);
  return round.is_accepted ? round.gain : kSmallGain;
}

KnotCurve CurveSearch::MovedBy(const KnotCurve& change, double share) const {
  return MovedWithinLimits(space_, now_, change, share, settings_);
}

double CurveSearch::GainOf(const KnotCurve& curve) const {
  return 1.0 - curve.Duration() / now_.Duration();
}

double CurveSearch::RunRound() {
  CurveRound round;
  round.sigma = settings_.sigma;
  round.pieces = now_.pieces();
  for (const PieceCells& cells : cells_) round.planes += cells.planes;
  const CurveStep step = SolveCurveProgram(now_, cells_, settings_);
  round.rows = step.rows;
  round.iterations = step.iterations;
  round.predicted = step.predicted;
  const bool are_few_to_blame = LearnCaution(step);
  KnotCurve moved = MovedBy(step.change, 1.0);
  double gain = GainOf(moved);
  // A step that only restores clearance is as good as any.
  const double ratio = step.predicted > 0.0 ? gain / step.predicted : kGoodStep;
  if (ratio < kGoodStep) {
    // gain(x) = predicted · x − (predicted − gain) x² is largest there.
    const double share = 0.5 / (1.0 - ratio);
    KnotCurve less = MovedBy(step.change, share);
    if (GainOf(less) > gain) {
      moved = std::move(less);
      gain = GainOf(moved);
    }
  }
  std::vector<PieceCells> cells;
  bool is_better = options_.margin > 0.0 || gain > 0.0;
  if (is_better && options_.margin > 0.0) {
    cells = CellsOf(space_, moved, settings_);
    gain += MeritOf(now_, cells_) - MeritOf(moved, cells);
    is_better = gain > 0.0;
  }
  round.is_accepted = is_better && Keep(moved);
  if (round.is_accepted) {
    now_ = std::move(moved);
    cells_ = options_.margin > 0.0 ? std::move(cells)
                                   : CellsOf(space_, now_, settings_);
  }
  ChangeSigma(round.is_accepted ? ratio : -1.0, !are_few_to_blame);
  round.duration = now_.Duration();
  round.gain = gain;
  summary_.rounds.push_back(round);
  return round.is_accepted ? std::max(gain, kFailed * step.predicted)
                           : step.predicted;
}

bool CurveSearch::LearnCaution(const CurveStep& step) {
  if (settings_.keeps_pace || !(step.predicted > 0.0)) return false;
  std::vector<double> slowings =
      SlowingOfPieces(Moved(now_, step.change, 1.0), options_.limits);
  for (double& slowing : slowings) slowing /= step.pace;
  const bool are_few_to_blame = caution_.Learn(slowings, step.predicted);
  settings_.caution = caution_.shares();
  return are_few_to_blame;
}

void CurveSearch::ChangeSigma(double ratio, bool may_shrink) {
  const double factor = ratio < 0.0   ? 0.3
                        : ratio < 0.3 ? 0.5
                        : ratio > 0.7 ? 2.0
                                      : 1.0;
  if (factor < 1.0 && !may_shrink) return;
  settings_.sigma = std::min(factor * settings_.sigma, kLargestSigma);
}

bool CurveSearch::Halve() {
  KnotCurve halved = now_.Halved();
  if (!settings_.keeps_pace) {
    halved.Slow(SlowingOf(halved, options_.limits));
  }
  for (ViaKnot& via : settings_.via) via.knot *= 2;
  settings_.sigma = std::max(settings_.sigma, kLeastSigmaOfHalves);
  caution_.Halve();
  settings_.caution = caution_.shares();
  if (!Keep(halved)) return false;
  now_ = std::move(halved);
  return true;
}

void CurveSearch::Measure(CurveSummary* summary) const {
  const double reach = settings_.trust + options_.margin;
  double clearance = std::numeric_limits<double>::infinity(), missing = 0.0;
  for (const CurvePiece& piece : summary->trajectory.pieces()) {
    KnotCurve::Points points;
    for (int j = 0; j < 6; ++j) points.col(j) = piece.point(j);
    const PieceCells cells =
        FindCells(space_, points, settings_.trust, options_.margin);
    const double by_chord =
        space_.Clearance(piece.front(), piece.back()) - piece.Bend();
    const double of_piece = std::max(by_chord, std::min(cells.distance, reach));
    clearance = std::min(clearance, of_piece);
    missing += std::max(0.0, options_.margin - of_piece);
  }
  summary->clearance = clearance;
  summary->margin = std::min(options_.margin, clearance);
  const auto pieces = static_cast<int>(summary->trajectory.pieces().size());
  summary->cost = summary->duration * (1.0 + PriceOf(missing, pieces));
}

void RequireCurve(double diagonal, const std::vector<Vector3d>& path,
                  const CurveOptions& options) {
  options.Validate();
  CheckOption(diagonal > 0.0 && std::isfinite(diagonal), "curve", "diagonal",
              "a finite length > 0", diagonal);
  if (!std::all_of(path.begin(), path.end(), IsFinite)) {
    throw InputError("path: expected finite points, found NaN or Inf");
  }
  if (std::all_of(path.begin(), path.end(),
                  [&](const Vector3d& q) { return q == path[0]; })) {
    throw InputError("path: expected two different points at least, found " +
                     std::string(path.empty() ? "none" : "one"));
  }
  auto at = path.begin();
  for (std::size_t i = 0; i < options.via.size(); ++i) {
    at = std::find(at, path.end(), options.via[i].point);
    if (at != path.end()) continue;
    throw InputError("curve: via " + std::to_string(i) +
                     ": expected a point of the path, in order, found (" +
                     FormatPoint(options.via[i].point) + ")");
  }
}

}  // namespace phongpd::internal
