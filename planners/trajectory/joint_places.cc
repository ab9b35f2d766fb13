// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/joint_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Span = std::pair<double, double>;

constexpr double kShortest = 0.25;  // of an even piece
// Inside of its tolerance, so that a step has room.
constexpr double kInside = 0.999;

bool Rests(const CurvePiece& piece, const Vector3d& point) {
  for (int j = 0; j <= piece.degree(); ++j) {
    if (piece.point(j) != point) return false;
  }
  return true;
}

// The joint until which it rests from another one on, for the dwell at least;
// none: not for so long.  `is_next`: the next place is the same, to rest there
// again: what is left of the rest is its.
std::optional<std::size_t> RestsUntil(const Trajectory& motion,
                                      std::size_t joint, const CurveVia& via,
                                      bool is_next) {
  // A rest may have lost as much by rounding of its times.
  constexpr double kLost = 1e-12;
  const auto& pieces = motion.pieces();
  const auto is_enough = [&](std::size_t until) {
    return motion.StartOf(until) - motion.StartOf(joint) >=
           (1.0 - kLost) * via.dwell;
  };
  std::size_t until = joint;
  while (until < pieces.size() && Rests(pieces[until], via.point) &&
         !(is_next && is_enough(until))) {
    ++until;
  }
  if (!is_enough(until)) return std::nullopt;
  return until;
}

// When it passes them, or rests there: the first joints at which it does, which
// are in order if any are.
std::optional<std::vector<Span>> TimesOf(const Trajectory& motion,
                                         const std::vector<CurveVia>& via) {
  std::vector<Span> times;
  const auto& pieces = motion.pieces();
  std::size_t joint = 1;
  for (std::size_t i = 0; i < via.size(); ++i) {
    const CurveVia& one = via[i];
    const bool is_next = i + 1 < via.size() && via[i + 1].dwell > 0.0 &&
                         via[i + 1].point == one.point;
    std::optional<std::size_t> until;
    for (; joint < pieces.size(); ++joint) {
      if (one.dwell > 0.0) {
        until = RestsUntil(motion, joint, one, is_next);
      } else if ((pieces[joint].front() - one.point).norm() <= one.tolerance) {
        until = joint;
      }
      if (until) break;
    }
    if (!until) return std::nullopt;
    times.emplace_back(motion.StartOf(joint), motion.StartOf(*until));
    joint = *until;
  }
  return times;
}

// Even times, of which the nearest make room for the given ones.
std::optional<std::vector<double>> Between(std::vector<double> given,
                                           double duration, int pieces) {
  const double h = duration / pieces;
  std::sort(given.begin(), given.end());
  given.erase(std::unique(given.begin(), given.end()), given.end());
  given.insert(given.begin(), 0.0);
  if (given.back() < duration) given.push_back(duration);
  std::vector<double> times = {0.0};
  for (std::size_t i = 1; i < given.size(); ++i) {
    const double span = given[i] - given[i - 1];
    if (!(span >= kShortest * h)) return std::nullopt;
    const int parts = std::max(1, static_cast<int>(std::lround(span / h)));
    for (int k = 1; k < parts; ++k) {
      times.push_back(given[i - 1] + span * k / parts);
    }
    times.push_back(given[i]);
  }
  return times;
}

}  // namespace

std::optional<JointKnots> JointKnotsOf(
    const std::vector<Trajectory>& motions,
    const std::vector<std::vector<CurveVia>>& via, double duration,
    int pieces) {
  std::vector<std::vector<Span>> spans;
  std::vector<double> given;
  for (std::size_t c = 0; c < motions.size(); ++c) {
    auto times = TimesOf(motions[c], via[c]);
    if (!times) return std::nullopt;
    for (const Span& span : *times) {
      given.push_back(span.first);
      given.push_back(span.second);
    }
    spans.push_back(std::move(*times));
  }
  const auto times = Between(std::move(given), duration, pieces);
  if (!times) return std::nullopt;
  JointKnots knots;
  knots.times = *times;
  const auto knot_at = [&](double t) {
    return static_cast<int>(std::lower_bound(times->begin(), times->end(), t) -
                            times->begin());
  };
  for (std::size_t c = 0; c < motions.size(); ++c) {
    knots.places.emplace_back();
    for (std::size_t i = 0; i < via[c].size(); ++i) {
      const Span& span = spans[c][i];
      knots.places.back().push_back(
          {via[c][i], knot_at(span.first), knot_at(span.second)});
    }
  }
  return knots;
}

void PutIntoPlaces(const std::vector<JointPlace>& places, KnotCurve* curve) {
  for (const JointPlace& place : places) {
    for (int k = place.first; k <= place.last; ++k) {
      KnotCurve::State& knot = curve->knots[k];
      if (place.via.dwell > 0.0) {
        knot = {place.via.point, Vector3d::Zero(), Vector3d::Zero()};
        continue;
      }
      const Vector3d off = knot.p - place.via.point;
      const double most = kInside * place.via.tolerance;
      if (off.norm() > most) knot.p = place.via.point + most / off.norm() * off;
    }
  }
}

double SlowingOfRests(const std::vector<JointPlace>& places,
                      const KnotCurve& curve) {
  double factor = 0.0;
  for (const JointPlace& place : places) {
    if (!(place.via.dwell > 0.0)) continue;
    double rest = 0.0;
    for (int k = place.first; k < place.last; ++k) rest += curve.durations[k];
    factor = std::max(factor, place.via.dwell / rest);
  }
  return factor;
}

std::vector<int> RestingKnots(const std::vector<JointPlace>& places) {
  std::vector<int> knots;
  for (const JointPlace& place : places) {
    if (!(place.via.dwell > 0.0)) continue;
    for (int k = place.first; k <= place.last; ++k) knots.push_back(k);
  }
  return knots;
}

std::vector<JointProgram::Row> RowsOfRests(
    const std::vector<JointPlace>& places, const KnotCurve& curve) {
  std::vector<JointProgram::Row> rows;
  for (const JointPlace& place : places) {
    if (!(place.via.dwell > 0.0)) continue;
    const double needed = SlowingOfRests({place}, curve);
    for (int k = place.first; k < place.last; ++k) {
      JointProgram::Row row;
      row.piece = k;
      row.eta = row.t = -1.0;
      row.constant = needed - 1.0;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace phongpd::internal
