// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/numbers.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Of every sum of products of up to eight numbers below, and to spare.
constexpr double kRelativeRounding = 64.0 * 0x1p-53;

// A trajectory is written out sample by sample: more are a slip of the unit.
constexpr double kMostSamples = 1e8;

// Of the largest coordinate: farther apart, pieces do not join.
constexpr double kJoint = 0x1p-40;

// Of a limit: durations remain numbers.
constexpr double kLeastLimit = 1e-50;

// Five nodes and weights of Gauss and Legendre on [−1, 1].
constexpr std::array<double, 5> kNodes = {
    -0.90617984593866399, -0.53846931010568309, 0.0, 0.53846931010568309,
    0.90617984593866399};
constexpr std::array<double, 5> kWeights = {
    0.23692688505618909, 0.47862867049936647, 0.56888888888888889,
    0.47862867049936647, 0.23692688505618909};

double SpeedIntegral(const CurvePiece& speed, double low, double high) {
  const double half = 0.5 * (high - low), middle = 0.5 * (high + low);
  double sum = 0.0;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    sum += kWeights[i] * speed.At(middle + half * kNodes[i]).norm();
  }
  return sum * half * speed.duration();
}

// Halves until both halves agree with the whole.
double Length(const CurvePiece& speed, double low, double high, double whole,
              double tolerance, int depth) {
  const double middle = 0.5 * (low + high);
  const double first = SpeedIntegral(speed, low, middle);
  const double second = SpeedIntegral(speed, middle, high);
  if (depth == 0 || std::abs(first + second - whole) <= tolerance) {
    return first + second;
  }
  return Length(speed, low, middle, first, 0.5 * tolerance, depth - 1) +
         Length(speed, middle, high, second, 0.5 * tolerance, depth - 1);
}

// A norm, at the price of one that may overflow where that does not.
double Norm(const Vector3d& x) {
  constexpr double kLeast = 1e-280, kMost = 1e280;
  const double squared = x.squaredNorm();
  return squared > kLeast && squared < kMost ? std::sqrt(squared)
                                             : x.stableNorm();
}

// The largest share of `limit` that the points of a derivative reach, rounded
// up by `rounding`, the absolute error that they may have.
double HullShare(const CurvePiece& derivative, const Vector3d& limit,
                 bool by_norm, double rounding) {
  double share = 0.0;
  for (int i = 0; i <= derivative.degree(); ++i) {
    const Vector3d x =
        (derivative.point(i).cwiseAbs().array() + rounding).matrix();
    share = std::max(share, by_norm ? Norm(x) / limit[0]
                                    : x.cwiseQuotient(limit).maxCoeff());
  }
  return share * (1.0 + kRelativeRounding);
}

double Largest(const CurvePiece& piece) {
  double largest = 0.0;
  for (int i = 0; i <= piece.degree(); ++i) {
    largest = std::max(largest, piece.point(i).cwiseAbs().maxCoeff());
  }
  return largest;
}

// `rounding`: of the points of `derivative`.  Splitting averages, which adds
// an error of its own but does not enlarge the old one.
double SplitShare(const CurvePiece& derivative, const Vector3d& limit,
                  bool by_norm, double rounding, int depth) {
  const double whole = HullShare(derivative, limit, by_norm, rounding);
  if (depth == 0 || derivative.degree() <= 1) return whole;
  const auto half = derivative.Split(0.5);
  rounding += kRelativeRounding * Largest(derivative);
  return std::min(
      whole,
      std::max(SplitShare(half[0], limit, by_norm, rounding, depth - 1),
               SplitShare(half[1], limit, by_norm, rounding, depth - 1)));
}

}  // namespace

CurvePiece::CurvePiece(const Vector3d& a, const Vector3d& b, double duration)
    : CurvePiece(std::array<Vector3d, 2>{a, b}.data(), 2, duration) {}

CurvePiece::CurvePiece(const std::vector<Vector3d>& points, double duration)
    : CurvePiece(points.data(), points.size(), duration) {}

CurvePiece::CurvePiece(const Vector3d* points, std::size_t count,
                       double duration)
    : degree_(static_cast<int>(count) - 1), duration_(duration) {
  if (count < 2 || count > points_.size()) {
    throw InputError("curve: expected 2 to " + std::to_string(kMaxDegree + 1) +
                     " points a piece, found " + std::to_string(count));
  }
  if (!std::all_of(points, points + count, IsFinite)) {
    throw InputError("curve: expected finite points, found NaN or Inf");
  }
  if (!(duration > 0.0) || !std::isfinite(duration)) {
    throw InputError(
        "curve: expected a duration above 0 and finite, in seconds, found " +
        FormatDouble(duration));
  }
  std::copy(points, points + count, points_.begin());
}

Vector3d CurvePiece::At(double s) const {
  // The ends to the last bit: pieces join there.
  if (s == 0.0) return front();
  if (s == 1.0) return back();
  Points p = points_;
  for (int left = degree_; left > 0; --left) {
    for (int i = 0; i < left; ++i) p[i] = (1.0 - s) * p[i] + s * p[i + 1];
  }
  return p[0];
}

CurvePiece CurvePiece::Derivative() const {
  CurvePiece result;
  result.duration_ = duration_;
  result.degree_ = std::max(degree_ - 1, 1);
  for (int i = 0; i < degree_; ++i) {
    result.points_[i] = (points_[i + 1] - points_[i]) * (degree_ / duration_);
  }
  if (degree_ == 1) result.points_[1] = result.points_[0];
  return result;
}

std::array<CurvePiece, 2> CurvePiece::Split(double s) const {
  std::array<CurvePiece, 2> parts = {*this, *this};
  parts[0].duration_ = s * duration_;
  parts[1].duration_ = (1.0 - s) * duration_;
  Points p = points_;
  for (int left = degree_; left > 0; --left) {
    for (int i = 0; i < left; ++i) p[i] = (1.0 - s) * p[i] + s * p[i + 1];
    parts[0].points_[degree_ - left + 1] = p[0];
    parts[1].points_[left - 1] = p[left - 1];
  }
  return parts;
}

CurvePiece CurvePiece::Elevated() const {
  CurvePiece result = *this;
  result.degree_ = degree_ + 1;
  for (int i = 1; i <= degree_; ++i) {
    const double share = static_cast<double>(i) / result.degree_;
    result.points_[i] = share * points_[i - 1] + (1.0 - share) * points_[i];
  }
  result.points_[result.degree_] = points_[degree_];
  return result;
}

double CurvePiece::Bend() const {
  double bend = 0.0;
  for (int i = 1; i < degree_; ++i) {
    const double share = static_cast<double>(i) / degree_;
    const Vector3d on_chord = (1.0 - share) * front() + share * back();
    bend = std::max(bend, Norm(points_[i] - on_chord));
  }
  return bend;
}

Trajectory::Trajectory(std::vector<CurvePiece> pieces)
    : pieces_(std::move(pieces)) {
  double time = 0.0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (i > 0 && pieces_[i].front() != pieces_[i - 1].back()) {
      throw InputError("trajectory: piece " + std::to_string(i) +
                       " does not begin where piece " + std::to_string(i - 1) +
                       " ends; they must agree to the last bit");
    }
    time += pieces_[i].duration();
    times_.push_back(time);
  }
  if (!std::isfinite(time)) {
    throw InputError("trajectory: its duration is beyond what a double holds");
  }
}

Trajectory Trajectory::Joined(std::vector<CurvePiece> pieces, double* moved) {
  double largest = 0.0;
  for (const CurvePiece& piece : pieces) {
    largest = std::max(largest, Largest(piece));
  }
  *moved = 0.0;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const Vector3d& end = pieces[i - 1].back();
    const double gap = (pieces[i].front() - end).stableNorm();
    if (gap == 0.0 || gap > kJoint * largest) continue;
    const Vector3d* first = &pieces[i].front();
    std::vector<Vector3d> points(first, first + pieces[i].degree() + 1);
    points[0] = end;
    pieces[i] = CurvePiece(points, pieces[i].duration());
    *moved = std::max(*moved, gap * (1.0 + kRelativeRounding));
  }
  return Trajectory(std::move(pieces));
}

Trajectory Trajectory::Along(const std::vector<Vector3d>& path) {
  if (path.size() < 2) {
    throw InputError("path: expected two points at least, found " +
                     std::to_string(path.size()));
  }
  std::vector<CurvePiece> pieces;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    pieces.emplace_back(path[i], path[i + 1], 1.0);
  }
  return Trajectory(std::move(pieces));
}

std::size_t Trajectory::PiecesBefore(double t) const {
  return static_cast<std::size_t>(
      std::upper_bound(times_.begin(), times_.end(), t) - times_.begin());
}

Trajectory::Sample Trajectory::At(double t) const {
  const auto end = std::upper_bound(times_.begin(), times_.end() - 1, t);
  const auto i = static_cast<std::size_t>(end - times_.begin());
  const CurvePiece& piece = pieces_[i];
  // The end to the last bit, wherever the sum of durations was rounded to.
  const double s =
      t >= times_[i]
          ? 1.0
          : std::clamp((t - StartOf(i)) / piece.duration(), 0.0, 1.0);
  const CurvePiece velocity = piece.Derivative();
  Sample sample;
  sample.time = std::clamp(t, 0.0, duration());
  sample.position = piece.At(s);
  sample.velocity = velocity.At(s);
  if (piece.degree() < 2) return sample;
  const CurvePiece acceleration = velocity.Derivative();
  sample.acceleration = acceleration.At(s);
  if (piece.degree() < 3) return sample;
  sample.jerk = acceleration.Derivative().At(s);
  return sample;
}

std::vector<Trajectory::Sample> Trajectory::Samples(double rate) const {
  if (!(rate > 0.0) || !(rate * duration() <= kMostSamples)) {
    throw InputError("rate: expected samples a second above 0, and at most " +
                     std::to_string(static_cast<long>(kMostSamples)) +
                     " samples in all, found " + FormatDouble(rate) +
                     " for a motion of " + FormatDouble(duration()) + " s");
  }
  std::vector<Sample> samples;
  if (empty()) return samples;
  for (long i = 0;; ++i) {
    const double time = static_cast<double>(i) / rate;
    if (time >= duration()) break;
    samples.push_back(At(time));
  }
  samples.push_back(At(duration()));
  return samples;
}

double Trajectory::ArcLength() const {
  // Enough halvings for a cusp, where the speed is no polynomial.
  constexpr int kDepth = 30;
  constexpr double kTolerance = 1e-9;
  double length = 0.0;
  for (const CurvePiece& piece : pieces_) {
    if (piece.degree() == 1) {
      length += (piece.back() - piece.front()).stableNorm();
      continue;
    }
    const CurvePiece speed = piece.Derivative();
    double polygon = 0.0;  // at least as long as the curve
    for (int i = 0; i < piece.degree(); ++i) {
      polygon += (piece.point(i + 1) - piece.point(i)).stableNorm();
    }
    length += Length(speed, 0.0, 1.0, SpeedIntegral(speed, 0.0, 1.0),
                     kTolerance * polygon, kDepth);
  }
  return length;
}

Trajectory Trajectory::Slowed(double factor) const {
  std::vector<CurvePiece> slow;
  for (const CurvePiece& piece : pieces_) {
    slow.emplace_back(&piece.front(),
                      static_cast<std::size_t>(piece.degree()) + 1,
                      piece.duration() * factor);
  }
  return Trajectory(std::move(slow));
}

double Trajectory::JointGap(int k) const {
  double gap = 0.0;
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
    Vector3d before = pieces_[i].back(), after = pieces_[i + 1].front();
    CurvePiece a = pieces_[i], b = pieces_[i + 1];
    for (int order = 1; order <= k; ++order) {
      const bool a_bends = a.degree() >= 1 && pieces_[i].degree() >= order;
      const bool b_bends = b.degree() >= 1 && pieces_[i + 1].degree() >= order;
      a = a.Derivative();
      b = b.Derivative();
      before = a_bends ? a.back() : Vector3d(Vector3d::Zero());
      after = b_bends ? b.front() : Vector3d(Vector3d::Zero());
    }
    gap = std::max(gap, (after - before).stableNorm());
  }
  return gap;
}

void MotionLimits::Validate() const {
  const auto check = [&](const Vector3d& limit, const char* name) {
    for (int axis = 0; axis < (by_norm ? 1 : 3); ++axis) {
      if (limit[axis] >= kLeastLimit && std::isfinite(limit[axis])) continue;
      const std::string which =
          by_norm ? std::string() : std::string(" of ") + "xyz"[axis];
      throw InputError(std::string("limits: ") + name + which +
                       ": expected a number above 0, " +
                       FormatDouble(kLeastLimit) + " at least, found " +
                       FormatDouble(limit[axis]));
    }
  };
  check(velocity, "velocity");
  check(acceleration, "acceleration");
  check(jerk, "jerk");
}

double LimitUse::SlowingNeeded() const {
  return std::max({velocity, std::sqrt(acceleration), std::cbrt(jerk)});
}

LimitUse BoundLimitUse(const Trajectory& trajectory, const MotionLimits& limits,
                       int depth) {
  LimitUse use;
  for (const CurvePiece& piece : trajectory.pieces()) {
    CurvePiece derivative = piece;
    // How far the points may be from those of the exact derivative: what those
    // of the one before may be, twice, and three roundings of their own.
    double rounding = 0.0;
    const auto next = [&](const Vector3d& limit, double* share) {
      const double by = derivative.degree() / derivative.duration();
      derivative = derivative.Derivative();
      rounding = 2.0 * by * rounding + 4.0 * 0x1p-53 * Largest(derivative);
      *share = std::max(*share, SplitShare(derivative, limit, limits.by_norm,
                                           rounding, depth));
    };
    next(limits.velocity, &use.velocity);
    if (piece.degree() >= 2) next(limits.acceleration, &use.acceleration);
    if (piece.degree() >= 3) next(limits.jerk, &use.jerk);
  }
  return use;
}

}  // namespace phongpd
