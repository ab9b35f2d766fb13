// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/curve_verification.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "constraints/curve_hull.h"
#include "core/number_text.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// A part is not halved further that is smaller, as a share of the largest
// coordinate: its boxes are no smaller.
constexpr double kSmallestPart = 0x1p-44;
// Parts of parts that touch all the way to rounding, and what is taken for it.
constexpr int kClose = 3;
constexpr double kNoise = 0x1p-12;  // of Verifier::rounding
constexpr long kMostTests = 1'000'000;
// Displacements that are tried, as shares of the rounding; a little is left for
// the rounding of their sums.
constexpr double kWithin = 0.999;
constexpr double kNearer = 0.25;

class CurveVerification {
 public:
  explicit CurveVerification(const CurveGround& ground)
      : ground_(ground), noise_(kNoise * ground.rounding + ground.least_step) {}

  Verification Run(const Trajectory& curve) {
    for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
      const CurvePiece& piece = curve.pieces()[i];
      piece_ = i;
      largest_ = 0.0;
      for (int j = 0; j <= piece.degree(); ++j) {
        largest_ = std::max(largest_, piece.point(j).cwiseAbs().maxCoeff());
      }
      if (piece.degree() == 1 && IsFree(piece.front(), piece.back())) {
        is_start_free_ = true;
        continue;
      }
      const CurveHull whole(piece);
      const double start = curve.StartOf(i);
      if (!CheckPart(whole, start, piece.duration(), nullptr)) break;
    }
    return result_;
  }

 private:
  struct Known {
    bool first, last;  // is the robot free where the part begins and ends?
    int close;  // of the parts that hold it, how many one by one were so close
                // that rounding hides the gap?
  };

  // False: refuted, or undecided for good.
  bool CheckPart(const CurveHull& part, double start, double duration,
                 const Known* given) {
    HullGap gap;
    if (IsHullFree(part, Vector3d::Zero(), &gap)) return true;
    const std::array<CurveHull, 2> half = part.Halves();
    const double middle = start + 0.5 * duration;
    const Vector3d first = part.At(0), q = half[1].At(0);
    const Vector3d last = part.At(part.size() - 1);
    Known known = given != nullptr
                      ? *given
                      : Known{IsFree(first, first), IsFree(last, last), 0};
    const bool is_middle_free = IsFree(q, q);
    known.close = std::abs(gap.gap) <= noise_ ? known.close + 1 : 0;
    // Else it is the hull that comes so close, not the curve.
    const bool may_touch =
        !(known.first && is_middle_free && known.last) || known.close >= kClose;
    if (may_touch && gap.gap > -ground_.rounding && IsNearlyFree(part, gap)) {
      return Note(Verdict::kWithinRounding, middle, q);
    }
    if (given == nullptr && !known.first && IsBlockedAround(first)) {
      return Note(Verdict::kRefuted, start, first);
    }
    if (!is_middle_free && IsBlockedAround(q)) {
      return Note(Verdict::kRefuted, middle, q);
    }
    if (given == nullptr && !known.last && IsBlockedAround(last)) {
      return Note(Verdict::kRefuted, start + duration, last);
    }
    if (result_.tests >= kMostTests || Size(part) <= kSmallestPart * largest_) {
      is_start_free_ = false;
      return Note(Verdict::kUndecided, middle, q) && result_.tests < kMostTests;
    }
    const Known before = {known.first, is_middle_free, known.close};
    const Known after = {is_middle_free, known.last, known.close};
    return CheckPart(half[0], start, 0.5 * duration, &before) &&
           CheckPart(half[1], middle, 0.5 * duration, &after);
  }

  // All of the part, moved by v; `gap`: of what keeps it from being proved.
  bool IsHullFree(const CurveHull& part, const Vector3d& v, HullGap* gap) {
    ++result_.tests;
    const bool is_moved = !v.isZero(0.0);
    const CurveHull hull = is_moved ? part.MovedBy(v) : part;
    *gap = GapToBounds(hull);
    if (gap->is_apart && ground_.oracle != nullptr) {
      *gap = ground_.oracle->FindHullGap(hull);
      // Apart from all surfaces: inside for all q or for none.
      if (gap->is_apart && (is_moved || !is_start_free_)) {
        gap->is_apart = !ground_.oracle->Collides(hull.low(0));
      }
    }
    if (gap->is_apart) is_start_free_ = !is_moved;
    return gap->is_apart;
  }

  HullGap GapToBounds(const CurveHull& hull) const {
    HullGap least;
    if (ground_.bounds.IsEmpty()) return least;
    for (int i = 0; i < hull.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const double below = hull.low(i)[k] - ground_.bounds.min[k];
        const double above = ground_.bounds.max[k] - hull.high(i)[k];
        if (std::min(below, above) < least.gap) {
          least.gap = std::min(below, above);
          least.axis = (below < above ? 1.0 : -1.0) * Vector3d::Unit(k);
        }
      }
    }
    // Differences of doubles have the right sign.
    least.is_apart = least.gap > 0.0;
    return least;
  }

  bool IsNearlyFree(const CurveHull& part, const HullGap& gap) {
    HullGap ignored;
    const double whole = kWithin * ground_.rounding;
    if (IsHullFree(part, whole * gap.axis, &ignored)) return true;
    for (const double share : {1.0, kNearer}) {
      for (const Vector3d& direction : *ground_.directions) {
        if (IsHullFree(part, share * whole * direction, &ignored)) return true;
      }
    }
    return false;
  }

  bool IsWithinBounds(const Vector3d& q) const {
    const BoundingBox& bounds = ground_.bounds;
    return bounds.IsEmpty() || ((q.array() > bounds.min.array()).all() &&
                                (q.array() < bounds.max.array()).all());
  }

  // Of straight motions, exactly.
  bool IsFree(const Vector3d& a, const Vector3d& b) {
    ++result_.tests;
    return IsWithinBounds(a) && IsWithinBounds(b) &&
           (ground_.oracle == nullptr || !ground_.oracle->Collides(a, b));
  }

  // Wherever it is moved to by the rounding.
  bool IsBlockedAround(const Vector3d& q) {
    for (const double share : {1.0, kNearer}) {
      for (const Vector3d& direction : *ground_.directions) {
        const Vector3d x = q + share * ground_.rounding * direction;
        if (IsFree(x, x)) return false;
      }
    }
    return true;
  }

  // The worst, the first of its kind; true: it may go on.
  bool Note(Verdict verdict, double time, const Vector3d& q) {
    if (result_.verdict >= verdict) return true;
    result_.verdict = verdict;
    std::string what;
    if (verdict == Verdict::kUndecided) {
      what = " is closer to contact than halving it can tell";
    } else if (!IsWithinBounds(q)) {
      what = " is not strictly within the bounds";
    } else {
      what = " collides" + ground_.name_obstacle(q);
    }
    result_.reason =
        "piece " + std::to_string(piece_) + what + " at " + FormatDouble(time) +
        " s" +
        (verdict == Verdict::kWithinRounding ? ", by less than the rounding"
                                             : "");
    return verdict != Verdict::kRefuted;
  }

  static double Size(const CurveHull& part) {
    Vector3d low = part.low(0), high = part.high(0);
    for (int i = 1; i < part.size(); ++i) {
      low = low.cwiseMin(part.low(i));
      high = high.cwiseMax(part.high(i));
    }
    return (high - low).maxCoeff();
  }

  const CurveGround& ground_;
  const double noise_;  // more than gaps are wrong by
  std::size_t piece_ = 0;
  double largest_ = 0.0;
  bool is_start_free_ = false;  // of the part that comes next, exactly
  Verification result_;
};

}  // namespace

Verification VerifyCurve(const CurveGround& ground, const Trajectory& curve) {
  return CurveVerification(ground).Run(curve);
}

}  // namespace phongpd::internal
