// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace phongpd {

// A polynomial curve for a time, in Bézier form of degree n:
//
//   q(s) = Σ_i C(n, i) (1 − s)ⁿ⁻ⁱ sⁱ b_i,   s = t/h ∈ [0, 1].
//
// It lies in the convex hull of its points b_i; its derivatives by time are
// curves of the same form, of degree n − 1, …, with points (n/h)(b_{i+1} −
// b_i). Degree 1 is a straight motion at constant speed.
class CurvePiece {
 public:
  static constexpr int kMaxDegree = 7;
  using Points = std::array<Eigen::Vector3d, kMaxDegree + 1>;

  // Straight.
  CurvePiece(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
             double duration);
  // 2 to kMaxDegree + 1 points, duration > 0; finite.  Throws InputError.
  CurvePiece(const std::vector<Eigen::Vector3d>& points, double duration);
  // The same of points[0] … points[count − 1].
  CurvePiece(const Eigen::Vector3d* points, std::size_t count, double duration);

  int degree() const { return degree_; }
  double duration() const { return duration_; }  // h, seconds
  const Eigen::Vector3d& point(int i) const { return points_[i]; }
  const Eigen::Vector3d& front() const { return points_[0]; }
  const Eigen::Vector3d& back() const { return points_[degree_]; }

  // By de Casteljau; outside [0, 1] it is the same polynomial.
  Eigen::Vector3d At(double s) const;
  // By time, of degree n − 1; the derivative of degree 1 is constant, written
  // as a straight piece with equal ends.
  CurvePiece Derivative() const;
  // The parts before and after s ∈ (0, 1), of durations s·h and (1 − s)·h: the
  // same curve but for rounding, 2n ulps of the largest coordinate.
  std::array<CurvePiece, 2> Split(double s) const;
  // The same curve written with one degree more, rounded; degree < kMaxDegree.
  CurvePiece Elevated() const;

  // max_i |b_i − (b_0 + (i/n)(b_n − b_0))|: how far the curve can be from its
  // chord.
  double Bend() const;

 private:
  CurvePiece() = default;

  Points points_;
  int degree_ = 1;
  double duration_ = 1.0;
};

// A motion in time: pieces one after the other, each beginning where the one
// before it ends, to the last bit.  A polyline is a trajectory of degree 1.
//
// Each piece is smooth.  At the joints the trajectory is of class C² if
// velocities and accelerations agree there; that is up to its maker, and
// JointGap tells by how much they differ.
class Trajectory {
 public:
  Trajectory() = default;
  // Throws InputError that names the piece where they do not join.
  explicit Trajectory(std::vector<CurvePiece> pieces);
  // Of pieces from elsewhere, which join but for rounding: each begins where
  // the one before it ends, where that is within 2⁻⁴⁰ of the largest
  // coordinate.  The curve is nowhere farther than *moved, in the points' unit,
  // from the one given: the `blur` of CheckCurve.  Throws as above where pieces
  // are farther apart.
  static Trajectory Joined(std::vector<CurvePiece> pieces, double* moved);
  // Straight segments, a second each; two points at least.
  static Trajectory Along(const std::vector<Eigen::Vector3d>& path);

  bool empty() const { return pieces_.empty(); }
  const std::vector<CurvePiece>& pieces() const { return pieces_; }
  double duration() const { return times_.empty() ? 0.0 : times_.back(); }
  // When piece i begins; StartOf(size) is the duration.
  double StartOf(std::size_t i) const { return i == 0 ? 0.0 : times_[i - 1]; }
  // How many pieces have ended by t.
  std::size_t PiecesBefore(double t) const;

  struct Sample {
    double time = 0.0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
    Eigen::Vector3d jerk = Eigen::Vector3d::Zero();
  };
  // At t, clamped to [0, duration]; at a joint that of the later piece.
  // Requires a trajectory that is not empty.
  Sample At(double t) const;
  // At 0, 1/rate, 2/rate, … and at the end.  Throws InputError unless rate > 0
  // and the samples are at most 10⁸.
  std::vector<Sample> Samples(double rate) const;

  // ∫ |q'| dt to a relative error of about 1e-9.
  double ArcLength() const;

  // The same way `factor` > 0 times as slowly.
  Trajectory Slowed(double factor) const;

  // The largest jump of the k-th derivative by time, k = 1, 2, at a joint.
  double JointGap(int k) const;

 private:
  std::vector<CurvePiece> pieces_;
  std::vector<double> times_;  // when each ends
};

// How a motion begins or ends; at rest unless said.
struct CurveEnd {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();

  bool IsAtRest() const {
    return velocity.isZero(0.0) && acceleration.isZero(0.0);
  }
};

// What a machine can do, of each axis or of the norm.
struct MotionLimits {
  Eigen::Vector3d velocity = Eigen::Vector3d::Constant(kNone);
  Eigen::Vector3d acceleration = Eigen::Vector3d::Constant(kNone);
  Eigen::Vector3d jerk = Eigen::Vector3d::Constant(kNone);
  // Of |q'|, |q''|, |q'''| instead of each coordinate: the first number counts.
  bool by_norm = false;

  static constexpr double kNone = 1e300;  // as good as no limit

  // Throws InputError that names the limit and the axis: finite, and at least
  // 1e-50, so that durations remain numbers.
  void Validate() const;
};

// Upper bounds of velocity, acceleration and jerk, as shares of the limits: at
// most 1 means that the limits are kept for all t.  From the hull of the
// derivatives' points, rounded up; after `depth` halvings the bounds are within
// about 4^−depth of the truth.
struct LimitUse {
  double velocity = 0.0, acceleration = 0.0, jerk = 0.0;

  bool IsKept() const {
    return velocity <= 1.0 && acceleration <= 1.0 && jerk <= 1.0;
  }
  // The least f such that the motion slowed by f keeps them:
  // max(velocity, acceleration^½, jerk^⅓).
  double SlowingNeeded() const;
};
LimitUse BoundLimitUse(const Trajectory& trajectory, const MotionLimits& limits,
                       int depth = 3);

}  // namespace phongpd
