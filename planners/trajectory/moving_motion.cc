// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/moving_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

#include "core/stopwatch.h"
#include "planners/trajectory/knot_curve.h"
#include "planners/trajectory/timed_roads.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

// Times at which roads are tried, in the time of the fastest fixed motion; so
// many times as often in the end.
constexpr double kSteps = 40.0, kFiner = 8.0;
// Of the time of the fastest fixed motion: as good as can be expected.
constexpr double kFastEnough = 1.02;
// Slower variants of a motion: for what goes the same way ahead.
constexpr std::array<double, 4> kSlower = {1.2, 1.5, 2.0, 3.0};
// A path's segments are parted until no part is longer, a share of the path.
constexpr double kLongestPart = 0.2;
// Places beside the paths, sought in the paths' box grown by that share of its
// diagonal, and roads from each, to places of paths and to others.
// More of them where nothing is found.
constexpr int kPlacesBeside = 40, kMorePlacesBeside = 80, kTriesForPlace = 10;
constexpr std::size_t kRoadsFrom = 5;
constexpr double kGrowth = 0.5;
// Of searches, roads judged.
constexpr long kMostChecks = 4'000, kMostChecksBeside = 4'000;
// So many rides are made one in all combinations, more of them with the first
// or the last.
constexpr std::size_t kFewRides = 4;
// Of D: how near a motion that leaves out a rest comes to where it was.
constexpr double kNearRest = 0.02;

// Slowed so that the limits hold for all t.
Trajectory WithinLimits(const Trajectory& motion, const MotionLimits& limits) {
  constexpr double kRounding = 1e-12;
  const LimitUse use = BoundLimitUse(motion, limits);
  return use.IsKept() ? motion
                      : motion.Slowed(use.SlowingNeeded() * (1.0 + kRounding));
}

// A share of the way, and its derivatives by time.
struct Along {
  double s = 0.0, v = 0.0, a = 0.0;

  Along After(double time, double jerk) const {
    return {s + time * (v + time * (a / 2.0 + time * jerk / 6.0)),
            v + time * (a + time * jerk / 2.0), a + time * jerk};
  }
};

// What the limits leave of each derivative of a share of the way.
double LeastShare(const Vector3d& limit, const Vector3d& way, bool by_norm) {
  return by_norm ? limit[0] / way.norm()
                 : limit.cwiseQuotient(way.cwiseAbs()).minCoeff();
}

// The largest speed on a way of length 1 from rest to rest.
double LargestSpeed(double v, double a, double j) {
  const auto length = [&](double speed) {  // of both ramps
    return speed * j >= a * a ? speed * (speed / a + a / j)
                              : 2.0 * speed * std::sqrt(speed / j);
  };
  if (length(v) <= 1.0) return v;
  const double by_ramps =
      0.5 * a * (std::sqrt(a * a / j / j + 4.0 / a) - a / j);
  return by_ramps * j >= a * a ? by_ramps : std::cbrt(0.25 * j);
}

// Straight from rest to rest in the least time: by the largest jerks, with the
// largest acceleration and speed between them where there is time for these.
Trajectory FastStraight(const Vector3d& p, const Vector3d& q,
                        const MotionLimits& limits) {
  // Of the time of a ramp: so short that it is no number to work with.
  constexpr double kNoTime = 1e-6;
  const Vector3d way = q - p;
  const double v = LeastShare(limits.velocity, way, limits.by_norm);
  const double j = LeastShare(limits.jerk, way, limits.by_norm);
  // No more than jerks can come to on that way, where there is no limit.
  const double a =
      std::min(LeastShare(limits.acceleration, way, limits.by_norm),
               2.0 * std::sqrt(std::cbrt(0.25 * j) * j));
  const double speed = LargestSpeed(v, a, j);
  const bool is_long = speed * j >= a * a;
  const double by_jerk = is_long ? a / j : std::sqrt(speed / j);
  const double by_acceleration = is_long ? speed / a - by_jerk : 0.0;
  const double ramp = 2.0 * by_jerk + by_acceleration;
  if (!(by_jerk > kNoTime * ramp) || !std::isfinite(ramp)) {
    return WithinLimits(StopAtCorners({p, q}, limits, 3).ToTrajectory(),
                        limits);
  }
  const double cruise = std::max(0.0, 1.0 / speed - ramp);
  const std::array<std::pair<double, double>, 7> phases = {
      {{by_jerk, j},
       {by_acceleration, 0.0},
       {by_jerk, -j},
       {cruise, 0.0},
       {by_jerk, -j},
       {by_acceleration, 0.0},
       {by_jerk, j}}};
  KnotCurve curve;
  Along at;
  curve.knots.push_back({p, Vector3d::Zero(), Vector3d::Zero()});
  for (const auto& [time, jerk] : phases) {
    at = at.After(time, jerk);
    if (!(time > kNoTime * ramp)) continue;
    curve.knots.push_back({p + at.s * way, at.v * way, at.a * way});
    curve.durations.push_back(time);
  }
  curve.knots.back() = {q, Vector3d::Zero(), Vector3d::Zero()};
  return WithinLimits(curve.ToTrajectory(), limits);
}

class WayThrough {
 public:
  WayThrough(const MovingTask& task, const std::vector<FixedMotion>& ways)
      : task_(task), ways_(ways), last_(LastMotion(task.bodies)) {
    fastest_ = std::numeric_limits<double>::infinity();
    for (const FixedMotion& way : ways) {
      fastest_ = std::min(fastest_, way.motion.duration());
    }
  }

  MovingMotion Run() {
    clearance_ = task_.options.margin;
    Search();
    if (best_.motion.empty() && clearance_ > 0.0 && !task_.margin_is_required) {
      clearance_ = 0.0;
      Search();
    }
    best_.is_cut_short = IsOver();
    if (!best_.motion.empty()) {
      best_.clearance = ProvedClearance(task_.fixed, task_.bodies, best_.motion,
                                        task_.options.margin);
    }
    return best_;
  }

 private:
  void Search() {
    if (TryAsTheyAre()) return;
    TimedRoads roads;
    roads.places = {ways_[0].path.front(), ways_[0].path.back()};
    for (const FixedMotion& way : ways_) AddWay(way, &roads);
    Ride(roads, 1.0, kMostChecks);
    if (BestTime() <= kFastEnough * fastest_) return;
    if (task_.options.via.empty()) {
      for (const int places : {kPlacesBeside, kMorePlacesBeside}) {
        AddPlacesBeside(places, &roads);
        Ride(roads, 1.0, kMostChecksBeside * places / kPlacesBeside);
        if (!best_.motion.empty()) break;
      }
    }
    if (best_.motion.empty() || rides_.empty()) return;
    const TimedRoads chain = Smoothed();
    Ride(chain, kFiner, kMostChecks);
  }

  bool IsOver() const {
    return stopwatch_.Seconds() > task_.options.time_limit ||
           (task_.options.is_interrupted && task_.options.is_interrupted());
  }

  double BestTime() const {
    return best_.motion.empty() ? std::numeric_limits<double>::infinity()
                                : best_.motion.duration();
  }

  // The judge has the last word.
  bool Keep(const Trajectory& motion, std::size_t way) {
    if (!(motion.duration() < BestTime()) ||
        !BoundLimitUse(motion, task_.options.limits).IsKept() ||
        !CheckCurveAmong(task_.fixed, {}, motion).IsFree() ||
        !CheckAgainst(task_.bodies, motion, 0.0,
                      std::max(motion.duration(), last_), clearance_)
             .IsFree()) {
      return false;
    }
    best_.motion = motion;
    best_.way = way;
    return true;
  }

  // True: nothing can be faster.
  bool TryAsTheyAre() {
    for (std::size_t i = 0; i < ways_.size(); ++i) Keep(ways_[i].motion, i);
    return BestTime() <= fastest_;
  }

  int PlaceOf(const Vector3d& q, TimedRoads* roads) const {
    for (std::size_t i = 0; i < roads->places.size(); ++i) {
      if (roads->places[i] == q) return static_cast<int>(i);
    }
    roads->places.push_back(q);
    return static_cast<int>(roads->places.size()) - 1;
  }

  // There and back, where it is free.
  void AddStraight(int a, int b, TimedRoads* roads) const {
    const Vector3d& p = roads->places[static_cast<std::size_t>(a)];
    const Vector3d& q = roads->places[static_cast<std::size_t>(b)];
    if (a == b || !task_.fixed.IsFree(p, q)) return;
    if (task_.margin_is_required &&
        task_.fixed.Clearance(p, q) < task_.options.margin) {
      return;
    }
    for (const bool is_back : {false, true}) {
      Points line = {p, q};
      if (is_back) std::swap(line[0], line[1]);
      roads->roads.push_back(
          {is_back ? b : a, is_back ? a : b,
           FastStraight(line[0], line[1], task_.options.limits)});
    }
  }

  void AddWay(const FixedMotion& way, TimedRoads* roads) const {
    roads->roads.push_back({0, 1, way.motion});
    for (const double factor : kSlower) {
      roads->roads.push_back({0, 1, way.motion.Slowed(factor)});
    }
    if (!task_.options.via.empty()) return;
    const Points corners =
        DropCorners(task_.fixed, way.path, task_.options.margin);
    const double longest = kLongestPart * PathLength(corners);
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const Vector3d way_on = corners[i + 1] - corners[i];
      const double parts = std::max(1.0, std::ceil(way_on.norm() / longest));
      std::vector<int> places = {PlaceOf(corners[i], roads)};
      for (double k = 1.0; k < parts; k += 1.0) {
        places.push_back(PlaceOf(corners[i] + k / parts * way_on, roads));
      }
      places.push_back(PlaceOf(corners[i + 1], roads));
      for (std::size_t a = 0; a < places.size(); ++a) {
        for (std::size_t b = a + 1; b < places.size(); ++b) {
          AddStraight(places[a], places[b], roads);
        }
      }
    }
  }

  // The box of the paths, grown; within the bounds.
  BoundingBox BoxAround() const {
    BoundingBox box = {ways_[0].path[0], ways_[0].path[0]};
    for (const FixedMotion& way : ways_) {
      for (const Vector3d& q : way.path) {
        box.min = box.min.cwiseMin(q);
        box.max = box.max.cwiseMax(q);
      }
    }
    const double by = kGrowth * (box.max - box.min).norm();
    box.min.array() -= by;
    box.max.array() += by;
    const BoundingBox& bounds = task_.bounds;
    if (!bounds.IsEmpty()) {
      box.min = box.min.cwiseMax(bounds.min);
      box.max = box.max.cwiseMin(bounds.max);
    }
    return box;
  }

  // The same ones every time.
  void AddPlacesBeside(int count, TimedRoads* roads) const {
    const BoundingBox box = BoxAround();
    std::mt19937_64 random(static_cast<std::uint64_t>(count));
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const std::size_t before = roads->places.size();
    for (int i = 0; i < kTriesForPlace * count; ++i) {
      Vector3d q;
      for (int k = 0; k < 3; ++k) {
        q[k] = box.min[k] + share(random) * (box.max[k] - box.min[k]);
      }
      if (!task_.fixed.IsFree(q)) continue;
      roads->places.push_back(q);
      if (roads->places.size() == before + static_cast<std::size_t>(count))
        break;
    }
    for (std::size_t i = before; i < roads->places.size(); ++i) {
      AddNearest(i, 0, before, roads);
      AddNearest(i, before, i, roads);
    }
  }

  // Roads to the nearest of places[first … last − 1].
  void AddNearest(std::size_t place, std::size_t first, std::size_t last,
                  TimedRoads* roads) const {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t k = first; k < last; ++k) {
      near.emplace_back((roads->places[k] - roads->places[place]).norm(), k);
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), kRoadsFrom));
    for (const auto& [distance, k] : near) {
      AddStraight(static_cast<int>(k), static_cast<int>(place), roads);
    }
  }

  // Keeps the rides if they are faster than what there is.
  void Ride(const TimedRoads& roads, double finer, long most_checks) {
    if (IsOver()) return;
    RideSearch search;
    search.step = fastest_ / (kSteps * finer);
    search.before = BestTime();
    search.clearance = clearance_;
    search.most_checks = most_checks;
    search.is_interrupted = [this] { return IsOver(); };
    const std::vector<TimedRide> rides = FindRides(roads, task_.bodies, search);
    if (rides.empty() || !Keep(MotionOf(roads, rides), best_.way)) return;
    rides_.clear();
    for (const TimedRide& ride : rides) {
      const auto& road = roads.roads[static_cast<std::size_t>(ride.road)];
      rides_.push_back(road.motion);
    }
  }

  // A fast motion along these, near all of them if `visits`; empty: none.
  Trajectory Fast(const Points& line, bool visits) const {
    CurveOptions options = task_.options;
    options.via.clear();
    options.preset = Preset::kFast;
    options.time_limit =
        std::max(task_.options.time_limit - stopwatch_.Seconds(), 1e-3);
    for (std::size_t i = 1; visits && i + 1 < line.size(); ++i) {
      options.via.push_back({line[i], kNearRest * task_.diagonal, 0.0});
    }
    return OptimizeCurve(task_.fixed, task_.diagonal, line, options).trajectory;
  }

  // The rides found, and faster ones between the places where they rest.
  TimedRoads Smoothed() const {
    TimedRoads chain;
    Points rests = {rides_[0].pieces().front().front()};
    for (const Trajectory& ride : rides_) {
      rests.push_back(ride.pieces().back().back());
    }
    chain.places = {rests.front(), rests.back()};
    std::vector<int> places;
    for (const Vector3d& q : rests) places.push_back(PlaceOf(q, &chain));
    for (const FixedMotion& way : ways_) {
      chain.roads.push_back({0, 1, way.motion});
    }
    const std::size_t last = rides_.size();
    for (std::size_t i = 0; i < last; ++i) {
      chain.roads.push_back({places[i], places[i + 1], rides_[i]});
      // One ride alone is as fast as it can be.
      for (std::size_t j = i + 2; j <= last; ++j) {
        const bool is_asked = i == 0 || j == last || last <= kFewRides;
        if (!is_asked || IsOver() || rests[i] == rests[j]) continue;
        const Points line(rests.begin() + static_cast<std::ptrdiff_t>(i),
                          rests.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        for (const bool visits : {false, true}) {
          const Trajectory fast = Fast(line, visits);
          if (fast.empty()) continue;
          chain.roads.push_back({places[i], places[j], fast});
        }
      }
    }
    return chain;
  }

  const Stopwatch stopwatch_;
  const MovingTask& task_;
  const std::vector<FixedMotion>& ways_;
  const double last_;
  double fastest_ = 0.0;    // of the fixed motions, s
  double clearance_ = 0.0;  // asked for
  MovingMotion best_;
  std::vector<Trajectory> rides_;  // of the best
};

}  // namespace

MovingMotion FindMotionAmong(const MovingTask& task,
                             const std::vector<FixedMotion>& ways) {
  return WayThrough(task, ways).Run();
}

}  // namespace phongpd::internal
