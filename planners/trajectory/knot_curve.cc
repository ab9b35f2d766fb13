// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/knot_curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Of the largest coordinate: what curves on a segment may be off it, and more.
constexpr double kOffSegment = 1e-12;

double Share(const Vector3d& x, const Vector3d& limit, bool by_norm) {
  return by_norm ? x.stableNorm() / limit[0]
                 : x.cwiseAbs().cwiseQuotient(limit).maxCoeff();
}

template <typename Points>
double LargestShare(const Points& points, const Vector3d& limit, bool by_norm) {
  double largest = 0.0;
  for (int j = 0; j < points.cols(); ++j) {
    largest = std::max(largest, Share(points.col(j), limit, by_norm));
  }
  return largest;
}

// The state of 10s³ − 15s⁴ + 6s⁵ along `way` at s, in a time of 1.
KnotCurve::State AlongSegment(const Vector3d& from, const Vector3d& way,
                              double s) {
  const double r = 1.0 - s;
  return {from + s * s * s * (10.0 - 15.0 * s + 6.0 * s * s) * way,
          30.0 * s * s * r * r * way, 60.0 * s * r * (r - s) * way};
}

}  // namespace

double KnotCurve::Duration() const {
  return std::accumulate(durations.begin(), durations.end(), 0.0);
}

KnotCurve::Points KnotCurve::PointsOf(int piece) const {
  const State& a = knots[piece];
  const State& b = knots[piece + 1];
  const double h = durations[piece];
  Points points;
  points.col(0) = a.p;
  points.col(1) = a.p + (h / 5.0) * a.v;
  points.col(2) = a.p + (2.0 * h / 5.0) * a.v + (h * h / 20.0) * a.a;
  points.col(3) = b.p - (2.0 * h / 5.0) * b.v + (h * h / 20.0) * b.a;
  points.col(4) = b.p - (h / 5.0) * b.v;
  points.col(5) = b.p;
  return points;
}

Trajectory KnotCurve::ToTrajectory() const {
  std::vector<CurvePiece> result;
  result.reserve(durations.size());
  std::vector<Vector3d> points(6);
  for (int i = 0; i < pieces(); ++i) {
    const Points all = PointsOf(i);
    for (int j = 0; j < 6; ++j) points[j] = all.col(j);
    result.emplace_back(points, durations[i]);
  }
  return Trajectory(std::move(result));
}

void KnotCurve::Slow(double factor) {
  for (double& h : durations) h *= factor;
  for (State& state : knots) {
    state.v /= factor;
    state.a /= factor * factor;
  }
}

KnotCurve KnotCurve::Halved() const {
  KnotCurve result;
  result.knots.push_back(knots[0]);
  for (int i = 0; i < pieces(); ++i) {
    Points b = PointsOf(i);
    const double h = durations[i];
    // de Casteljau down to the three points of the middle state.
    for (int left = 5; left > 2; --left) {
      for (int j = 0; j < left; ++j) {
        b.col(j) = 0.5 * (b.col(j) + b.col(j + 1)).eval();
      }
    }
    State middle;
    middle.p = 0.25 * (b.col(0) + 2.0 * b.col(1) + b.col(2));
    middle.v = (5.0 / (2.0 * h)) * (b.col(2) - b.col(0));
    middle.a = (20.0 / (h * h)) * (b.col(0) - 2.0 * b.col(1) + b.col(2));
    result.knots.push_back(middle);
    result.knots.push_back(knots[i + 1]);
    result.durations.insert(result.durations.end(), 2, 0.5 * h);
  }
  return result;
}

PieceDerivatives::PieceDerivatives(const KnotCurve::Points& points,
                                   double duration)
    : velocity((5.0 / duration) *
               (points.rightCols<5>() - points.leftCols<5>())),
      acceleration((4.0 / duration) *
                   (velocity.rightCols<4>() - velocity.leftCols<4>())),
      jerk((3.0 / duration) *
           (acceleration.rightCols<3>() - acceleration.leftCols<3>())) {}

double SlowingOf(const KnotCurve& curve, const MotionLimits& limits) {
  const std::vector<double> all = SlowingOfPieces(curve, limits);
  return *std::max_element(all.begin(), all.end());
}

std::vector<double> SlowingOfPieces(const KnotCurve& curve,
                                    const MotionLimits& limits) {
  std::vector<double> all;
  for (int i = 0; i < curve.pieces(); ++i) {
    const PieceDerivatives of(curve.PointsOf(i), curve.durations[i]);
    const bool norm = limits.by_norm;
    const double velocity = LargestShare(of.velocity, limits.velocity, norm);
    const double acceleration =
        LargestShare(of.acceleration, limits.acceleration, norm);
    const double jerk = LargestShare(of.jerk, limits.jerk, norm);
    all.push_back(
        std::max({velocity, std::sqrt(acceleration), std::cbrt(jerk)}));
  }
  return all;
}

std::vector<Vector3d> DropCorners(const FreeSpace& space,
                                  const std::vector<Vector3d>& path,
                                  double clearance) {
  double farthest = 0.0;
  for (const Vector3d& p : path) {
    farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  }
  const double enough = std::max(clearance, kOffSegment * farthest);
  std::vector<double> kept(path.size(), 0.0);  // by the segment after a point
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    kept[i] = std::min(enough, space.Clearance(path[i], path[i + 1]));
  }
  std::vector<Vector3d> corners = {path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t next = at + 1;
    double least = kept[at];
    std::vector<double> wanted(path.size(), 0.0);
    for (std::size_t to = at + 1; to < path.size(); ++to) {
      least = std::min(least, kept[to - 1]);
      wanted[to] = least;
    }
    for (std::size_t to = path.size() - 1; to > at + 1; --to) {
      if (space.IsFree(path[at], path[to]) &&
          space.Clearance(path[at], path[to]) >= wanted[to]) {
        next = to;
        break;
      }
    }
    at = next;
    if (path[at] != corners.back()) corners.push_back(path[at]);
  }
  return corners;
}

KnotCurve StopAtCorners(const std::vector<Vector3d>& path,
                        const MotionLimits& limits, int pieces) {
  KnotCurve whole;
  KnotCurve::State first;
  first.p = path.front();
  whole.knots.push_back(first);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    KnotCurve segment;
    for (int k = 0; k <= pieces; ++k) {
      segment.knots.push_back(
          AlongSegment(path[i], path[i + 1] - path[i],
                       static_cast<double>(k) / static_cast<double>(pieces)));
    }
    segment.knots.back() = {path[i + 1], Vector3d::Zero(), Vector3d::Zero()};
    segment.durations.assign(pieces, 1.0 / pieces);
    segment.Slow(SlowingOf(segment, limits));
    whole.knots.insert(whole.knots.end(), segment.knots.begin() + 1,
                       segment.knots.end());
    whole.durations.insert(whole.durations.end(), segment.durations.begin(),
                           segment.durations.end());
  }
  return whole;
}

}  // namespace phongpd::internal
