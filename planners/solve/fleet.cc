// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/fleet.h"

#include <algorithm>
#include <set>
#include <utility>

#include "constraints/motion_oracle.h"
#include "constraints/moving_judge.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/stopwatch.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Order = std::vector<std::size_t>;

bool Stays(const FleetRobot& robot) {
  return robot.request.start == robot.request.goal && robot.request.via.empty();
}

void RequireApart(const FleetRobot& a, const FleetRobot& b, bool at_start) {
  const Vector3d& p = at_start ? a.request.start : a.request.goal;
  const Vector3d& q = at_start ? b.request.start : b.request.goal;
  const MotionOracle oracle(a.world.workspace().robot,
                            b.world.workspace().robot);
  if (!oracle.Collides(p - q)) return;
  throw InputError("robots: \"" + a.name + "\" at (" + FormatPoint(p) +
                   ") and \"" + b.name + "\" at (" + FormatPoint(q) +
                   ") touch at their " + (at_start ? "starts" : "goals"));
}

// What moves is kept off from rest to rest, in as little time as is found.
void RequireRest(const FleetRobot& robot) {
  const OptimizeRequest& request = robot.request;
  if (request.duration > 0.0) {
    throw InputError("robots: \"" + robot.name +
                     "\": expected no given duration among others, found " +
                     FormatDouble(request.duration) + " s");
  }
  if (request.departure.IsAtRest() && request.arrival.IsAtRest()) return;
  throw InputError("robots: \"" + robot.name +
                   "\": expected rest at start and goal among others, found a "
                   "velocity or an acceleration");
}

// Of a robot that stays; the others keep off it.
PathAnswer Resting(const FleetRobot& robot) {
  constexpr double kMoment = 1.0;  // s
  const Vector3d& q = robot.request.start;
  PathAnswer answer;
  const Diagnosis diagnosis = robot.world.Diagnose(q);
  answer.curve = CurveSummary();
  if (!diagnosis.IsFree()) {
    answer.reason = diagnosis.Text("start");
    answer.status = PathStatus::kStartInCollision;
    return answer;
  }
  answer.path = {q};
  answer.motion =
      Trajectory({CurvePiece(std::vector<Vector3d>(6, q), kMoment)});
  const std::vector<MovingBody> bodies =
      MovingBodies(robot.world, robot.request.moving);
  const double last = std::max(kMoment, LastMotion(bodies));
  const MovingCheck check = CheckAgainst(bodies, answer.motion, 0.0, last);
  if (!check.IsFree()) {
    answer.reason = "it stays where the moving obstacle \"" +
                    bodies[static_cast<std::size_t>(check.body)].name +
                    "\" comes at t = " + Rounded(check.time, 6);
    answer.motion = Trajectory();
    return answer;
  }
  answer.status = answer.curve->status = PathStatus::kConverged;
  answer.is_free = answer.is_solved = true;
  answer.evidence.free_space = robot.world.Convolution().free_space;
  answer.clearance = answer.curve->clearance =
      ProvedClearance(*answer.evidence.free_space, bodies, answer.motion,
                      robot.world.Resolve(robot.request.Margin()).unit);
  if (robot.request.verifies) {
    answer.evidence.verification =
        Verifier(robot.world.workspace()).VerifyPath(answer.path);
  }
  return answer;
}

// All pairs, and what is wrong with them.
void JudgeAll(const std::vector<FleetRobot>& robots, FleetAnswer* answer) {
  std::vector<MovingObstacle> bodies;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    bodies.push_back({robots[i].world.workspace().robot.Named(robots[i].name),
                      answer->robots[i].motion});
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const OptimizeRequest& request = robots[i].request;
    const RobotInTime own = {robots[i].name, robots[i].world, bodies[i].motion};
    for (std::size_t k = i + 1; k < robots.size(); ++k) {
      const bool verifies = request.verifies || robots[k].request.verifies;
      answer->pairs.push_back(JudgePair(own, bodies[k], verifies));
    }
    for (const MovingObstacle& other : request.moving) {
      answer->pairs.push_back(JudgePair(own, other, request.verifies));
    }
  }
  for (const FleetPair& pair : answer->pairs) {
    const bool is_refuted =
        pair.verification && pair.verification->verdict == Verdict::kRefuted;
    if (pair.is_free && !is_refuted) continue;
    answer->status = PathStatus::kVerificationFailed;
    answer->reason = "\"" + pair.first + "\" and \"" + pair.second + "\": " +
                     (is_refuted ? pair.verification->reason
                                 : "no proof that they keep off each other");
    return;
  }
}

// In that order, until one has no motion; its place in the order, or the
// number of robots.
std::size_t TryOrder(const std::vector<FleetRobot>& robots, const Order& order,
                     FleetAnswer* answer) {
  answer->robots.assign(robots.size(), {});
  std::vector<MovingObstacle> before;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const FleetRobot& robot = robots[order[i]];
    PathAnswer& own = answer->robots[order[i]];
    if (Stays(robot)) {
      own = Resting(robot);
    } else {
      OptimizeRequest request = robot.request;
      request.moving.insert(request.moving.end(), before.begin(), before.end());
      own = Optimize(robot.world, request);
    }
    if (!own.is_solved) return i;
    before.push_back(
        {robot.world.workspace().robot.Named(robot.name), own.motion});
  }
  return order.size();
}

}  // namespace

void RequireFleet(const std::vector<FleetRobot>& robots) {
  std::set<std::string> names;
  for (const FleetRobot& robot : robots) {
    if (!names.insert(robot.name).second) {
      throw InputError("robots: expected different names, found \"" +
                       robot.name + "\" twice");
    }
    if (!robot.request.limits) {
      throw InputError("robots: \"" + robot.name +
                       "\": expected limits of the motion, found none");
    }
    robot.request.Validate(robot.world);
    if (robots.size() > 1) RequireRest(robot);
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      RequireApart(robots[k], robots[i], true);
      RequireApart(robots[k], robots[i], false);
    }
  }
}

const FleetPair* FleetAnswer::Closest() const {
  const auto closest = std::min_element(
      pairs.begin(), pairs.end(),
      [](const FleetPair& a, const FleetPair& b) { return a.least < b.least; });
  return closest == pairs.end() ? nullptr : &*closest;
}

FleetAnswer OptimizeFleet(const std::vector<FleetRobot>& robots) {
  const Stopwatch stopwatch;
  RequireFleet(robots);
  Order order(robots.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto first_moving =
      std::stable_partition(order.begin(), order.end(),
                            [&](std::size_t i) { return Stays(robots[i]); });
  const auto staying = first_moving - order.begin();
  FleetAnswer answer;
  std::set<Order> tried;
  while (tried.insert(order).second) {
    ++answer.tries;
    answer.order = order;
    const std::size_t failed = TryOrder(robots, order, &answer);
    answer.status = PathStatus::kConverged;
    answer.reason.clear();
    if (failed == order.size()) {
      JudgeAll(robots, &answer);
      break;
    }
    const FleetRobot& robot = robots[order[failed]];
    const PathAnswer& own = answer.robots[order[failed]];
    answer.status = own.status;
    answer.reason = "\"" + robot.name + "\": " + own.reason;
    // Nobody's way: another order does not help.
    if (static_cast<std::ptrdiff_t>(failed) <= staying) break;
    const auto at = order.begin() + static_cast<std::ptrdiff_t>(failed);
    std::rotate(order.begin() + staying, at, at + 1);
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (Stays(robots[i])) continue;
    answer.duration =
        std::max(answer.duration, answer.robots[i].motion.duration());
  }
  answer.seconds = stopwatch.Seconds();
  return answer;
}

}  // namespace phongpd
