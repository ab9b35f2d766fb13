// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/timed_roads.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr double kNever = std::numeric_limits<double>::infinity();
// Ends of safe times are told to within that share of a step.
constexpr double kShareOfStep = 0.125;

class RideFinder {
 public:
  RideFinder(const TimedRoads& roads, const std::vector<MovingBody>& bodies,
             const RideSearch& search)
      : roads_(roads),
        bodies_(bodies),
        search_(search),
        last_(LastMotion(bodies)),
        from_(roads.places.size()),
        safe_(roads.places.size()),
        is_reached_(roads.places.size()) {
    for (std::size_t i = 0; i < roads.roads.size(); ++i) {
      from_[static_cast<std::size_t>(roads.roads[i].from)].push_back(
          static_cast<int>(i));
    }
    FindTimesToGoal();
  }

  std::vector<TimedRide> Run() {
    const auto& safe = SafeOf(0);
    if (safe.empty() || safe.front().begin > 0.0) return {};
    Push({0.0, -1, 0, 0, -1});
    while (!queue_.empty()) {
      const Entry entry = queue_.top();
      queue_.pop();
      if (entry.key >= search_.before || checks_ >= search_.most_checks ||
          (search_.is_interrupted && search_.is_interrupted())) {
        return {};
      }
      if (entry.road >= 0) {
        TryRoad(entry);
      } else if (Arrive(entry)) {
        return RidesTo(entry.label);
      }
    }
    return {};
  }

 private:
  // An arrival, or a road to be tried at a time.
  struct Entry {
    double time = 0.0;
    int road = -1;     // −1: an arrival
    int place = 0;     // of the arrival
    int interval = 0;  // of the arrival, or the least of the road's end
    int label = -1;    // where the robot comes from; of an arrival, itself
    double key = 0.0;  // no arrival at the goal is earlier
    bool operator<(const Entry& other) const { return key > other.key; }
  };
  // The robot at a place, and how it came there.
  struct Label {
    int place = 0, interval = 0;
    double time = 0.0;
    int before = -1, road = -1;
    double begin = 0.0;
  };

  double Duration(int road) const {
    return roads_.roads[static_cast<std::size_t>(road)].motion.duration();
  }
  int EndOf(int road) const {
    return roads_.roads[static_cast<std::size_t>(road)].to;
  }

  // Without bodies, a lower bound with them.
  void FindTimesToGoal() {
    to_goal_.assign(roads_.places.size(), kNever);
    to_goal_[1] = 0.0;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < roads_.roads.size(); ++i) {
        const auto& road = roads_.roads[i];
        double& time = to_goal_[static_cast<std::size_t>(road.from)];
        const double by_road = road.motion.duration() +
                               to_goal_[static_cast<std::size_t>(road.to)];
        if (by_road < time) time = by_road, changed = true;
      }
    }
  }

  const std::vector<SafeTime>& SafeOf(int place) {
    const auto i = static_cast<std::size_t>(place);
    if (!safe_[i]) {
      safe_[i] = SafeTimes(roads_.places[i], bodies_,
                           kShareOfStep * search_.step, search_.clearance);
      is_reached_[i].assign(safe_[i]->size(), false);
    }
    return *safe_[i];
  }

  void Push(Entry entry) {
    const bool is_arrival = entry.road < 0;
    if (is_arrival) {
      if (labels_.empty()) labels_.push_back({0, 0, 0.0, -1, -1, 0.0});
      entry.label = static_cast<int>(labels_.size()) - 1;
    }
    const int place = is_arrival ? entry.place : EndOf(entry.road);
    entry.key = entry.time + (is_arrival ? 0.0 : Duration(entry.road)) +
                to_goal_[static_cast<std::size_t>(place)];
    if (entry.key < search_.before) queue_.push(entry);
  }

  // True: at the goal, to stay.
  bool Arrive(const Entry& entry) {
    const Label label = labels_[static_cast<std::size_t>(entry.label)];
    const auto place = static_cast<std::size_t>(label.place);
    const auto interval = static_cast<std::size_t>(label.interval);
    if (is_reached_[place][interval]) return false;
    is_reached_[place][interval] = true;
    if (label.place == 1 && SafeOf(1)[interval].end == kNever) return true;
    for (const int road : from_[place]) {
      Push({label.time, road, label.place, 0, entry.label});
    }
    return false;
  }

  void TryRoad(Entry entry) {
    const Label label = labels_[static_cast<std::size_t>(entry.label)];
    const double leave_by =
        SafeOf(label.place)[static_cast<std::size_t>(label.interval)].end;
    const int to = EndOf(entry.road);
    const double duration = Duration(entry.road);
    const auto& there = SafeOf(to);
    const auto& reached = is_reached_[static_cast<std::size_t>(to)];
    auto k = static_cast<std::size_t>(entry.interval);
    // Intervals that are over, or that the robot was in before.
    while (k < there.size() &&
           (there[k].end < entry.time + duration || reached[k])) {
      ++k;
    }
    if (k == there.size()) return;
    entry.interval = static_cast<int>(k);
    const double earliest = there[k].begin - duration;
    if (earliest > entry.time) {
      entry.time = earliest;
      if (entry.time <= leave_by) Push(entry);
      return;
    }
    if (entry.time > leave_by) return;
    ++checks_;
    const auto& road = roads_.roads[static_cast<std::size_t>(entry.road)];
    if (CheckAgainst(bodies_, road.motion, entry.time, duration,
                     search_.clearance)
            .IsFree()) {
      labels_.push_back({to, entry.interval, entry.time + duration, entry.label,
                         entry.road, entry.time});
      Push({entry.time + duration, -1, to, entry.interval, -1});
      ++entry.interval;
      Push(entry);
    } else if (entry.time < last_) {
      entry.time += search_.step;
      Push(entry);
    }
  }

  std::vector<TimedRide> RidesTo(int label) const {
    std::vector<TimedRide> rides;
    for (; label >= 0;) {
      const Label& at = labels_[static_cast<std::size_t>(label)];
      if (at.road >= 0) rides.push_back({at.road, at.begin});
      label = at.before;
    }
    std::reverse(rides.begin(), rides.end());
    return rides;
  }

  const TimedRoads& roads_;
  const std::vector<MovingBody>& bodies_;
  const RideSearch& search_;
  const double last_;
  std::vector<std::vector<int>> from_;  // roads, by place
  std::vector<double> to_goal_;         // s, by place
  std::vector<std::optional<std::vector<SafeTime>>> safe_;
  std::vector<std::vector<bool>> is_reached_;  // by place and interval
  std::priority_queue<Entry> queue_;
  std::vector<Label> labels_;
  long checks_ = 0;
};

}  // namespace

std::vector<SafeTime> SafeTimes(const Vector3d& q,
                                const std::vector<MovingBody>& bodies,
                                double step, double clearance) {
  const auto is_free = [&](double begin, double length) {
    const Trajectory rest({CurvePiece(q, q, length)});
    return CheckAgainst(bodies, rest, begin, length, clearance).IsFree();
  };
  std::vector<SafeTime> safe;
  const auto add = [&](double begin, double end) {
    if (!safe.empty() && safe.back().end == begin) {
      safe.back().end = end;
    } else {
      safe.push_back({begin, end});
    }
  };
  const double last = LastMotion(bodies);
  const std::function<void(double, double)> look = [&](double begin,
                                                       double end) {
    if (is_free(begin, end - begin)) {
      add(begin, end);
    } else if (end - begin > step) {
      const double middle = 0.5 * (begin + end);
      look(begin, middle);
      look(middle, end);
    }
  };
  if (last > 0.0) look(0.0, last);
  // All of them rest.
  if (is_free(last, 1.0)) add(last, kNever);
  return safe;
}

std::vector<TimedRide> FindRides(const TimedRoads& roads,
                                 const std::vector<MovingBody>& bodies,
                                 const RideSearch& search) {
  return RideFinder(roads, bodies, search).Run();
}

Trajectory MotionOf(const TimedRoads& roads,
                    const std::vector<TimedRide>& rides) {
  std::vector<CurvePiece> pieces;
  double now = 0.0;
  for (const TimedRide& ride : rides) {
    const auto& road = roads.roads[static_cast<std::size_t>(ride.road)];
    const auto& moves = road.motion.pieces();
    const Vector3d& at = moves.front().front();
    if (ride.begin > now) {
      pieces.emplace_back(std::vector<Vector3d>(6, at), ride.begin - now);
      now = ride.begin;
    }
    pieces.insert(pieces.end(), moves.begin(), moves.end());
    now += road.motion.duration();
  }
  return Trajectory(std::move(pieces));
}

}  // namespace phongpd::internal
