// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "constraints/moving_judge.h"
#include "constraints/trajectory.h"

namespace phongpd::internal {

// Places to rest at, and motions from rest to rest between them that are free
// of what does not move.  From places[0] to places[1].
struct TimedRoads {
  struct Road {
    int from = 0, to = 0;
    Trajectory motion;
  };
  std::vector<Eigen::Vector3d> places;
  std::vector<Road> roads;
};

// A road taken at a time; before it the robot rests at the road's beginning.
struct TimedRide {
  int road = 0;
  double begin = 0.0;
};

struct RideSearch {
  double step = 0.0;       // roads are tried to begin so far apart, s
  double before = 0.0;     // s; no later arrival is looked for
  double clearance = 0.0;  // from the bodies
  long most_checks = 0;    // of roads
  std::function<bool()> is_interrupted;
};

// The rides that arrive first of those that the search tries, where the robot
// can stay for ever; none: it found none.  By safe intervals: of each place the
// times at which the robot may rest there, and of each interval the first
// arrival, as whoever is there first can wait.  Rides and rests are judged for
// all t (CheckAgainst).
std::vector<TimedRide> FindRides(const TimedRoads& roads,
                                 const std::vector<MovingBody>& bodies,
                                 const RideSearch& search);

// The rides and the rests between them as one motion from 0 on.
Trajectory MotionOf(const TimedRoads& roads,
                    const std::vector<TimedRide>& rides);

struct SafeTime {
  double begin = 0.0, end = 0.0;  // s; the last may have no end: infinity
};
// When a robot may rest at q: within that, with ends to within `step`.  Empty:
// never.
std::vector<SafeTime> SafeTimes(const Eigen::Vector3d& q,
                                const std::vector<MovingBody>& bodies,
                                double step, double clearance);

}  // namespace phongpd::internal
