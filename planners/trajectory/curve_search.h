// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "constraints/free_space.h"
#include "core/stopwatch.h"
#include "planners/trajectory/curve_caution.h"
#include "planners/trajectory/curve_cells.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd::internal {

struct CurveStart;

// OptimizeCurve in two parts, so that several of them can be compared before
// the work of the second: the first finds out what a way is good for.  Requests
// are checked before (RequireCurve); no place on the way is rested at.
class CurveSearch {
 public:
  // Time is counted from here.  `space` must outlive it.
  CurveSearch(const FreeSpace& space, double diagonal,
              const CurveOptions& options);

  // The first curve, and rounds on its pieces: all that kFast does.
  void Begin(const std::vector<Eigen::Vector3d>& path);
  // The rest of what the preset says; once, after Begin.
  void Refine();

  // What there is by now.
  CurveSummary Summary() const;

 private:
  using Path = std::vector<Eigen::Vector3d>;

  static constexpr double kTrust = 0.05;  // τ, of D
  static constexpr double kSigma = 0.03;  // σ of the first round
  static constexpr double kLargestSigma = 0.5;
  static constexpr double kGoodStep = 0.5;  // a smaller share of what was
                                            // predicted asks for a shorter step
  static constexpr double kSmallestSigma = 1e-5;
  // Steps that were too long for whole pieces need not be so for their halves.
  static constexpr double kLeastSigmaOfHalves = 0.003;
  // So few, by each halving that the preset has, are halved once more: they
  // cost little, and gain as much as many do by the halving before.
  static constexpr int kFewPieces = 40;
  // And so few, again by each halving, until they are more: a dozen cannot
  // follow the limits well.
  static constexpr int kLeastPieces = 16;
  // Fewer are halved whatever the preset.
  static constexpr int kFewest = 9;
  static constexpr int kMaxRounds = 60;  // of a size of pieces
  // A round that gains less, a share of the time, is the last of them; but not
  // where so much more was predicted that its step was too long.
  static constexpr double kSmallGain = 1e-3;
  static constexpr double kFailed = 0.2;
  static constexpr int kStepHalvings = 3;  // of a step that is not taken

  void Start(const Path& path);
  KnotCurve OptimizedFromRest(const CurveStart& start) const;
  // Becomes the answer if it passes its places and is proved free; and within
  // the limits, which what rests at its ends comes to be by Fit.
  bool Keep(const KnotCurve& curve);
  // In the least time in which it is proved within the limits; if there is no
  // proof, it is no answer.
  void Fit(CurveSummary* summary) const;
  bool MustEnd();
  // Of what so many pieces lack of the margin in all, as a share of the time.
  double PriceOf(double missing, int pieces) const;
  double MeritOf(const KnotCurve& curve,
                 const std::vector<PieceCells>& cells) const;
  // Rounds on pieces of one size, for least time and then, if a duration is
  // given, for least jerk.  False, as of RunRounds, if it must end.
  bool RunStage();
  bool RunRounds();
  bool IsFastEnough() const;
  // From now on the curve takes the time asked for.
  void KeepDuration();
  // What the mean of the squared jerk fell by, a share.
  double RunCalmRound();
  KnotCurve MovedBy(const KnotCurve& change, double share) const;
  double GainOf(const KnotCurve& curve) const;
  // What the merit fell by, a share of the time; or should have fallen by, if
  // the step is not taken.
  double RunRound();
  // What the whole step teaches; are few pieces to blame?
  bool LearnCaution(const CurveStep& step);
  // By the share of what was predicted that came true; < 0: no step was taken.
  // Where few pieces are to blame the others need no shorter steps.
  void ChangeSigma(double ratio, bool may_shrink);
  bool Halve();
  // Clearance, margin and cost of its trajectory: cells know all that is within
  // their reach.
  void Measure(CurveSummary* summary) const;

  const Stopwatch stopwatch_;
  const FreeSpace& space_;
  const CurveOptions options_;
  const double diagonal_;
  CurveProgramOptions settings_;
  CurveCaution caution_;
  bool is_calm_ = false;  // of the duration asked for
  bool goes_on_ = false;  // there is a curve, and nothing said to end
  KnotCurve now_;
  std::vector<PieceCells> cells_;
  CurveSummary summary_;
  bool is_fitted_ = true;  // Fit has been at its trajectory
};

// Throws what OptimizeCurve throws for requests.
void RequireCurve(double diagonal, const std::vector<Eigen::Vector3d>& path,
                  const CurveOptions& options);

}  // namespace phongpd::internal
