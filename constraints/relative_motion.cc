// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/relative_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Of all the time looked at: knots no farther apart are one.
constexpr double kJoinedKnots = 0x1p-48;
// What takes no time takes so much of that, because pieces take some.
constexpr double kLeastPiece = 0x1p-6;
// Of a time: sums and differences of three.
constexpr double kTimeRounding = 0x1p-50;
// Of a coordinate: of a split, for each degree; of a degree added; and of a
// difference.
constexpr double kSplitError = 0x1p-51;
constexpr double kElevationError = 0x1p-51;
constexpr double kDifferenceError = 0x1p-52;
// From an error of coordinates to a distance, and of the sum itself.
constexpr double kToDistance = 1.75;

constexpr double kForever = std::numeric_limits<double>::infinity();

// Parts of a motion, one after the other, on a clock that shows 0 when the
// motion's own shows `shift`.
class PartTaker {
 public:
  PartTaker(const Trajectory& motion, double shift)
      : motion_(motion), shift_(shift) {
    if (shift < 0.0) {
      end_ = -shift;
      resting_at_ = motion.pieces().front().front();
      next_ = 0;
      return;
    }
    next_ = motion.PiecesBefore(shift);
    Enter();
    const double begun = rest_ ? shift - motion.StartOf(next_ - 1) : 0.0;
    if (begun > 0.0) rest_ = Split(begun / rest_->duration())[1];
  }

  // When the part that is left ends.
  double end() const { return end_; }
  int most_splits() const { return most_splits_; }

  // From `now` until then, or to the end of what is left where that is within
  // `joined`; its duration is for the caller to say.
  CurvePiece Take(double now, double until, double joined) {
    CurvePiece part =
        rest_ ? *rest_ : CurvePiece(resting_at_, resting_at_, 1.0);
    if (end_ <= until + joined) {
      Enter();
    } else if (rest_) {
      auto parts = Split((until - now) / (end_ - now));
      part = parts[0];
      rest_ = parts[1];
    }
    return part;
  }

 private:
  // The next piece, or the rest at the end.
  void Enter() {
    splits_ = 0;
    if (next_ == motion_.pieces().size()) {
      rest_.reset();
      resting_at_ = motion_.pieces().back().back();
      end_ = kForever;
      return;
    }
    rest_ = motion_.pieces()[next_++];
    end_ = motion_.StartOf(next_) - shift_;
  }

  std::array<CurvePiece, 2> Split(double s) {
    most_splits_ = std::max(most_splits_, ++splits_);
    return rest_->Split(s);
  }

  const Trajectory& motion_;
  const double shift_;
  std::size_t next_ = 0;            // piece after the one that is left
  std::optional<CurvePiece> rest_;  // what is left of a piece; none: it rests
  Vector3d resting_at_ = Vector3d::Zero();
  double end_ = 0.0;
  int splits_ = 0, most_splits_ = 0;  // of a piece
};

CurvePiece Elevate(CurvePiece piece, int degree) {
  while (piece.degree() < degree) piece = piece.Elevated();
  return piece;
}

CurvePiece Difference(const CurvePiece& a, const CurvePiece& b,
                      double duration) {
  const int degree = std::max(a.degree(), b.degree());
  const CurvePiece from = Elevate(a, degree), off = Elevate(b, degree);
  CurvePiece::Points points;
  for (int i = 0; i <= degree; ++i) points[i] = from.point(i) - off.point(i);
  return CurvePiece(points.data(), static_cast<std::size_t>(degree) + 1,
                    duration);
}

// Bounds of a motion's coordinates and speeds, those of the pieces' points;
// rounded up.
struct Extent {
  explicit Extent(const Trajectory& motion) {
    for (const CurvePiece& piece : motion.pieces()) {
      Vector3d largest = piece.front().cwiseAbs(), step = Vector3d::Zero();
      for (int i = 1; i <= piece.degree(); ++i) {
        largest = largest.cwiseMax(piece.point(i).cwiseAbs());
        step = step.cwiseMax((piece.point(i) - piece.point(i - 1)).cwiseAbs());
      }
      const double of_piece = largest.maxCoeff();
      coordinate = std::max(coordinate, of_piece);
      // From the largest coordinate of a step to its length, with the rounding
      // of differences.
      speed = std::max(
          speed, piece.degree() / piece.duration() *
                     (kToDistance * step.maxCoeff() + 0x1p-50 * of_piece));
    }
  }
  double coordinate = 0.0, speed = 0.0;
};

void RequireTimes(const Trajectory& a, const Trajectory& b, double until,
                  double b_time) {
  if (a.empty() || b.empty()) {
    throw InputError(
        "relative motion: expected two motions, found an empty one");
  }
  if (!(until > 0.0) || !std::isfinite(until) || !std::isfinite(b_time)) {
    throw InputError(
        "relative motion: expected finite times, and an end above 0, found " +
        FormatDouble(until) + " and " + FormatDouble(b_time));
  }
}

}  // namespace

RelativeMotion RelativeMotionOf(const Trajectory& a, const Trajectory& b,
                                double until, double b_time) {
  RequireTimes(a, b, until, b_time);
  const double all = until + std::abs(b_time) + a.duration() + b.duration();
  const double joined = kJoinedKnots * all;
  PartTaker from(a, 0.0), off(b, b_time);
  std::vector<CurvePiece> pieces;
  for (double now = 0.0; now < until;) {
    double next = std::min(from.end(), off.end());
    if (next >= until - joined) next = until;
    next = std::max(next, now);
    const CurvePiece part = from.Take(now, next, joined);
    pieces.push_back(Difference(part, off.Take(now, next, joined),
                                std::max(next - now, kLeastPiece * joined)));
    now = next;
  }
  const Extent one(a), other(b);
  const auto knots = static_cast<double>(a.pieces().size() + b.pieces().size() +
                                         pieces.size());
  const double late = 4.0 * joined + knots * kTimeRounding * all;
  const double by_splits = CurvePiece::kMaxDegree * kSplitError *
                           (from.most_splits() * one.coordinate +
                            off.most_splits() * other.coordinate);
  const double by_sums =
      (CurvePiece::kMaxDegree * kElevationError + kDifferenceError) *
      (one.coordinate + other.coordinate);
  RelativeMotion result;
  result.curve = Trajectory(std::move(pieces));
  result.rounding =
      kToDistance * (by_splits + by_sums) + late * (one.speed + other.speed);
  return result;
}

}  // namespace phongpd
