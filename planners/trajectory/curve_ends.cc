// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_ends.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "constraints/curve_judge.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

// Motions to rest at places of the path: how many, and of how many durations
// each, from that at the limit of velocity to so many times that.
constexpr int kStopPlaces = 24;
constexpr int kDurations = 24;
constexpr double kLongest = 30.0;
// Of those within the limits the fastest are judged.
constexpr std::size_t kJudged = 100;
constexpr double kAllowance = 1e-12;  // over the limits, for rounding
// Below those of acceleration and jerk: what rounding makes of short pieces.
constexpr double kRoom = 1e-6;
// Of a stop's time: shorter phases are made longer, or ends of phases of
// different axes moved apart, by lower limits, drawn so often.
constexpr double kApart = 3e-3;
constexpr int kDraws = 50;
constexpr double kLowerAcceleration = 0.2, kLowerJerk = 0.05;
// Of D: within which to stop where nothing limits the acceleration.
constexpr double kSudden = 0.01;

struct Phase {
  double jerk, time;
};

// The least time of one axis from (v, a) to rest, wherever that is: a jerk,
// no jerk at the limit of acceleration, the jerk's opposite.  `splits`: the
// time at which the acceleration changes its sign ends a phase, so that the
// Bézier points of the velocity do not lie beyond it.
std::vector<Phase> StopOfAxis(double v, double a, double most_a, double most_j,
                              bool splits) {
  const double left = v + a * std::abs(a) / (2.0 * most_j);
  const double sign = left >= 0.0 ? 1.0 : -1.0;
  v *= sign;
  a *= sign;
  most_a = std::max(most_a, std::abs(a));
  double peak = std::sqrt(std::max(0.0, most_j * v + 0.5 * a * a));
  double hold = 0.0;
  if (peak > most_a) {
    peak = most_a;
    hold = (v + a * a / (2.0 * most_j) - peak * peak / most_j) / peak;
  }
  const double jerk = sign * most_j;
  std::vector<Phase> phases;
  const bool is_split = splits && a > 0.0;
  if (is_split) phases.push_back({-jerk, a / most_j});
  phases.push_back({-jerk, (is_split ? peak : peak + a) / most_j});
  phases.push_back({0.0, hold});
  phases.push_back({jerk, peak / most_j});
  return phases;
}

KnotCurve From(const KnotCurve::State& state) {
  KnotCurve curve;
  curve.knots.push_back(state);
  return curve;
}

void Append(const Vector3d& jerk, double time, KnotCurve* curve) {
  if (!(time > kAllowance * curve->Duration())) return;
  const KnotCurve::State& s = curve->knots.back();
  KnotCurve::State next;
  next.p = s.p + time * (s.v + time * (s.a / 2.0 + time / 6.0 * jerk));
  next.v = s.v + time * (s.a + time / 2.0 * jerk);
  next.a = s.a + time * jerk;
  curve->knots.push_back(next);
  curve->durations.push_back(time);
}

void EndAtRest(KnotCurve* curve) {
  curve->knots.back().v.setZero();
  curve->knots.back().a.setZero();
}

// With finite limits of acceleration and jerk.
MotionLimits Finite(const KnotCurve::State& state, MotionLimits limits,
                    double length) {
  const double speed = state.v.norm(), change = state.a.norm();
  double time = length / std::max(speed, 1e-100 * length);
  if (change > 0.0) time = std::min(time, std::sqrt(length / change));
  const double most = 2.0 * speed / time + change;
  for (int axis = 0; axis < 3; ++axis) {
    double& acceleration = limits.acceleration[axis];
    if (acceleration >= MotionLimits::kNone) acceleration = most;
    double& jerk = limits.jerk[axis];
    if (jerk >= MotionLimits::kNone) jerk = 2.0 * acceleration / time;
    acceleration *= 1.0 - kRoom;
    jerk *= 1.0 - kRoom;
  }
  return limits;
}

double LimitAlong(const Vector3d& direction, const Vector3d& limit,
                  bool by_norm) {
  return by_norm ? limit[0] / direction.norm()
                 : limit.cwiseQuotient(direction.cwiseAbs()).minCoeff();
}

KnotCurve StraightStop(KnotCurve::State state, const MotionLimits& limits,
                       bool splits) {
  const bool by_norm = limits.by_norm;
  KnotCurve curve = From(state);
  if (state.v.cross(state.a).norm() >
      kAllowance * state.v.norm() * state.a.norm()) {
    // Not so short that rounding spoils it.
    const double acceleration =
        LimitAlong(state.v, limits.acceleration, by_norm);
    const double jerk = LimitAlong(state.v, limits.jerk, by_norm);
    const double stop = 1.0 / acceleration + acceleration / jerk;
    const double time = std::max(
        1.0 / LimitAlong(state.a, limits.jerk, by_norm), 4.0 * kApart * stop);
    Append(-state.a / time, time, &curve);
    curve.knots.back().a.setZero();
    state = curve.knots.back();
  }
  const Vector3d direction =
      (state.v.isZero(0.0) ? state.a : state.v).stableNormalized();
  for (const Phase& phase :
       StopOfAxis(direction.dot(state.v), direction.dot(state.a),
                  LimitAlong(direction, limits.acceleration, by_norm),
                  LimitAlong(direction, limits.jerk, by_norm), splits)) {
    Append(phase.jerk * direction, phase.time, &curve);
  }
  EndAtRest(&curve);
  return curve;
}

KnotCurve StopByAxes(const KnotCurve::State& state, const MotionLimits& limits,
                     bool splits) {
  std::array<std::vector<Phase>, 3> phases;
  std::vector<double> times;  // at which some axis changes its jerk
  for (int axis = 0; axis < 3; ++axis) {
    phases[axis] =
        StopOfAxis(state.v[axis], state.a[axis], limits.acceleration[axis],
                   limits.jerk[axis], splits);
    double time = 0.0;
    for (const Phase& phase : phases[axis]) {
      time += std::max(0.0, phase.time);
      times.push_back(time);
    }
  }
  std::sort(times.begin(), times.end());
  KnotCurve curve = From(state);
  double now = 0.0;
  for (const double next : times) {
    if (next - now <= kAllowance * times.back()) continue;  // the same
    const double middle = 0.5 * (now + next);
    Vector3d jerk = Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      double end = 0.0;
      for (const Phase& phase : phases[axis]) {
        const double begin = end;
        end += std::max(0.0, phase.time);
        if (begin <= middle && middle < end) jerk[axis] = phase.jerk;
      }
    }
    Append(jerk, next - now, &curve);
    now = next;
  }
  EndAtRest(&curve);
  return curve;
}

bool IsWithin(const KnotCurve& curve, const MotionLimits& limits) {
  return SlowingOf(curve, limits) <= 1.0 + kAllowance;
}

// Is no piece so short that rounding spoils its derivatives?
bool IsEven(const KnotCurve& curve) {
  return *std::min_element(curve.durations.begin(), curve.durations.end()) >=
         kApart * curve.Duration();
}

bool IsFree(const FreeSpace& space, const KnotCurve& curve) {
  return CheckCurve(space, curve.ToTrajectory()).IsFree();
}

// From q to the last point of the path that is in sight of it, and on; nothing
// if none is.
Path WayOn(const FreeSpace& space, const Vector3d& q, const Path& path) {
  for (std::size_t k = path.size(); k-- > 0;) {
    if (!space.IsFree(q, path[k])) continue;
    Path way = {q};
    if (q == path[k]) ++k;
    way.insert(way.end(), path.begin() + static_cast<std::ptrdiff_t>(k),
               path.end());
    return way;
  }
  return {};
}

// Back along a stop to where the path begins, and on; nothing if corners that
// close to it are not free.
Path WayBack(const FreeSpace& space, const KnotCurve& stop, const Path& path) {
  const Trajectory trajectory = stop.ToTrajectory();
  for (const int points : {4, 16, 64}) {
    Path way;
    for (auto piece = trajectory.pieces().rbegin();
         piece != trajectory.pieces().rend(); ++piece) {
      for (int i = points; i > 0; --i) {
        way.push_back(piece->At(static_cast<double>(i) / points));
      }
    }
    way.insert(way.end(), path.begin(), path.end());
    if (CheckPath(space, way).free) return way;
  }
  return {};
}

struct Place {
  Vector3d q;
  double to_go;      // of the path's length
  std::size_t next;  // the path's point after it
};

std::vector<Place> PlacesOf(const Path& path) {
  std::vector<double> before = {0.0};
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    before.push_back(before.back() + (path[i + 1] - path[i]).norm());
  }
  std::vector<Place> places;
  std::size_t i = 0;
  for (int k = 1; k <= kStopPlaces; ++k) {
    // Closer together where it begins.
    const double share = static_cast<double>(k) / kStopPlaces;
    const double at = share * share * before.back();
    while (i + 2 < path.size() && before[i + 1] < at) ++i;
    const double length = before[i + 1] - before[i];
    const double along =
        length > 0.0 ? std::min(1.0, (at - before[i]) / length) : 1.0;
    places.push_back(
        {path[i] + along * (path[i + 1] - path[i]), before.back() - at, i + 1});
  }
  places.back().q = path.back();
  return places;
}

// To rest at a place of the path, in one polynomial: around corners that are
// closer than a stop is long.
Stop FindWayToRest(const FreeSpace& space, const KnotCurve::State& state,
                   const Path& path, const MotionLimits& limits) {
  struct Candidate {
    double estimate;
    KnotCurve curve;
    const Place* place;
  };
  const double speed =
      limits.by_norm ? limits.velocity[0] : limits.velocity.minCoeff();
  const double pace = std::min(speed, std::max(state.v.norm(), 1e-3 * speed));
  const std::vector<Place> places = PlacesOf(path);
  std::vector<Candidate> candidates;
  for (const Place& place : places) {
    const double least = (place.q - state.p).norm() / pace;
    if (!(least > 0.0) || !std::isfinite(least)) continue;
    for (int k = 0; k < kDurations; ++k) {
      const double share = static_cast<double>(k) / (kDurations - 1);
      KnotCurve curve = From(state);
      curve.knots.push_back(From({place.q}).knots[0]);
      curve.durations = {0.3 * least * std::pow(kLongest, share)};
      const double time = curve.durations[0] + place.to_go / pace;
      for (int i = 0; i < 2; ++i) curve = curve.Halved();
      if (!IsWithin(curve, limits)) continue;
      candidates.push_back({time, std::move(curve), &place});
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) {
              return a.estimate < b.estimate;
            });
  candidates.resize(std::min(candidates.size(), kJudged));
  for (Candidate& one : candidates) {
    if (!IsFree(space, one.curve)) continue;
    Path rest(path.begin() + static_cast<std::ptrdiff_t>(one.place->next),
              path.end());
    Path way = WayOn(space, one.place->q, rest);
    if (!way.empty()) return {std::move(one.curve), std::move(way)};
  }
  return {};
}

std::string Refusal(const FreeSpace& space, const KnotCurve::State& state,
                    const KnotCurve& stop, bool is_end) {
  const Trajectory trajectory = stop.ToTrajectory();
  const CurveCheck check = CheckCurve(space, trajectory);
  const double needed = trajectory.ArcLength();
  const Vector3d asked = is_end ? Vector3d(-state.v) : state.v;
  std::string text = std::string("curve: ") + (is_end ? "end" : "start") +
                     " velocity (" + FormatPoint(asked) +
                     "): " + (is_end ? "a run-up to it" : "a stop from it") +
                     " within the limits is " + Rounded(needed) + " long, and ";
  if (check.IsFree()) {
    text += "no way between that and the path was found";
  } else {
    const double free =
        (trajectory.At(check.free_until).position - state.p).norm();
    text += std::string("the way ") + (is_end ? "to (" : "from (") +
            FormatPoint(state.p) + ") is free for " +
            Rounded(std::min(free, needed));
  }
  return text + "; expected a lower velocity, or higher limits";
}

}  // namespace

bool IsAtRest(const KnotCurve::State& state) {
  return state.v.isZero(0.0) && state.a.isZero(0.0);
}

KnotCurve Backwards(const KnotCurve& curve) {
  KnotCurve back = curve;
  std::reverse(back.knots.begin(), back.knots.end());
  std::reverse(back.durations.begin(), back.durations.end());
  for (KnotCurve::State& state : back.knots) state.v = -state.v;
  return back;
}

KnotCurve Joined(const KnotCurve& first, const KnotCurve& second) {
  if (first.knots.empty()) return second;
  KnotCurve both = first;
  if (second.knots.empty()) return both;
  both.knots.insert(both.knots.end(), second.knots.begin() + 1,
                    second.knots.end());
  both.durations.insert(both.durations.end(), second.durations.begin(),
                        second.durations.end());
  return both;
}

std::vector<KnotCurve> StopsFrom(const KnotCurve::State& state,
                                 const MotionLimits& limits, double length) {
  const MotionLimits finite = Finite(state, limits, length);
  std::vector<KnotCurve> stops;
  for (const bool is_straight : {true, false}) {
    if (!is_straight && limits.by_norm) break;
    for (int i = 0; i < kDraws; ++i) {
      MotionLimits lower = finite;
      for (int axis = 0; axis < 3; ++axis) {
        // Of a lattice: anything that is spread evenly does.
        const double draw = std::fmod(i * (0.41 + 0.17 * axis), 1.0);
        lower.acceleration[axis] *= 1.0 - kLowerAcceleration * draw;
        lower.jerk[axis] *= 1.0 - kLowerJerk * std::fmod(7.0 * draw, 1.0);
      }
      KnotCurve stop = is_straight ? StraightStop(state, lower, i % 2 == 0)
                                   : StopByAxes(state, lower, i % 2 == 0);
      if (!IsWithin(stop, limits) || !IsEven(stop)) continue;
      stops.push_back(std::move(stop));
      break;
    }
  }
  return stops;
}

Stop FindStop(const FreeSpace& space, double diagonal,
              const KnotCurve::State& state, const Path& path,
              const MotionLimits& limits, bool is_end) {
  if (IsAtRest(state)) return {{}, path};
  std::vector<KnotCurve> stops = StopsFrom(state, limits, kSudden * diagonal);
  for (KnotCurve& stop : stops) {
    if (!IsFree(space, stop)) continue;
    Path way = WayOn(space, stop.knots.back().p, path);
    if (way.empty()) way = WayBack(space, stop, path);
    if (!way.empty()) return {std::move(stop), std::move(way)};
  }
  Stop found = FindWayToRest(space, state, path, limits);
  if (!found.curve.knots.empty()) return found;
  if (stops.empty())
    stops = {
        StraightStop(state, Finite(state, limits, kSudden * diagonal), true)};
  throw InputError(Refusal(space, state, stops[0], is_end));
}

}  // namespace phongpd::internal
