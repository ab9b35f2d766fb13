// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/fleet.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "constraints/motion_oracle.h"
#include "constraints/moving_judge.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/stopwatch.h"
#include "planners/solve/fleet_together.h"

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

// Tries of more orders for a sooner end, for which each costs a fleet's work.
int MoreOrders(Preset preset) {
  switch (preset) {
    case Preset::kFast:
      return 0;
    case Preset::kBalanced:
      return 1;
    case Preset::kTight:
      break;
  }
  return 6;
}

// Orders of one fleet, one after the other.
class FleetSearch {
 public:
  explicit FleetSearch(const std::vector<FleetRobot>& robots)
      : robots_(robots) {}

  FleetAnswer Run() {
    FleetAnswer by_order;
    if (!RunAlone(&by_order)) return by_order;
    FindFirst(FirstOrder(), &by_order);
    if (!by_order.IsSolved()) return by_order;
    FleetAnswer best = Hastened(by_order);
    if (TurnsAreFaster(by_order, &best)) return best;
    int tries = by_order.tries;
    for (int more = MostMore(); more > 0 && HasRoom(best); --more) {
      const std::optional<Order> order = NextOrder(by_order);
      if (!order) break;
      FleetAnswer other = by_order;
      ++tries;
      if (Try(*order, kLater * by_order.duration, &other) < order->size() ||
          !other.IsSolved()) {
        continue;
      }
      FleetAnswer hastened = Hastened(other);
      if (hastened.duration < best.duration) best = std::move(hastened);
      if (other.duration < by_order.duration) by_order = std::move(other);
    }
    best.tries = tries;
    return best;
  }

 private:
  // Made faster together, where that is certified.
  FleetAnswer Hastened(FleetAnswer answer) const {
    answer.by_order = answer.duration;
    if (IsInterrupted() || answer.duration <= Wanted()) return answer;
    auto together = internal::Hastened(robots_, answer, Wanted());
    if (!together) return answer;
    JudgeAll(robots_, &*together);
    return together->IsSolved() ? std::move(*together) : answer;
  }

  // From motions that all turn the same way; other orders are no better then.
  bool TurnsAreFaster(const FleetAnswer& by_order, FleetAnswer* best) const {
    if (!HasRoom(*best)) return false;
    auto turned = internal::HastenedInTurns(robots_, by_order, Wanted());
    if (!turned || turned->duration >= best->duration) return false;
    turned->by_order = by_order.duration;
    JudgeAll(robots_, &*turned);
    if (!turned->IsSolved()) return false;
    *best = std::move(*turned);
    return true;
  }

  // As good as can be expected.  Among what moves by itself a robot may be
  // faster than it was alone, where it waited.
  double Wanted() const {
    for (const FleetRobot& robot : robots_) {
      if (!robot.request.moving.empty()) return 0.0;
    }
    return kEnough * Slowest();
  }

  // Each as if there were no other robot.
  bool RunAlone(FleetAnswer* answer) {
    for (const FleetRobot& robot : robots_) {
      alone_.push_back(Stays(robot) ? Resting(robot)
                                    : Optimize(robot.world, robot.request));
      if (alone_.back().is_solved) continue;
      answer->robots = alone_;
      answer->robots.resize(robots_.size());
      answer->status = alone_.back().status;
      answer->reason = "\"" + robot.name + "\": " + alone_.back().reason;
      return false;
    }
    return true;
  }

  double Alone(std::size_t i) const { return alone_[i].motion.duration(); }

  // Those that stay, and then the slowest first: what is taken from the others
  // by giving way is theirs to lose.
  Order FirstOrder() {
    Order order(robots_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto moving =
        std::stable_partition(order.begin(), order.end(),
                              [&](std::size_t i) { return Stays(robots_[i]); });
    std::stable_sort(moving, order.end(), [&](std::size_t i, std::size_t k) {
      return Alone(i) > Alone(k);
    });
    staying_ = moving - order.begin();
    return order;
  }

  // Whoever finds no motion goes first in the next try.
  void FindFirst(Order order, FleetAnswer* answer) {
    constexpr double kAnyTime = std::numeric_limits<double>::infinity();
    while (tried_.insert(order).second) {
      ++answer->tries;
      const std::size_t failed = Try(order, kAnyTime, answer);
      // Nobody's way: another order does not help.
      if (failed == order.size() ||
          static_cast<std::ptrdiff_t>(failed) <= staying_) {
        return;
      }
      ToPlace(failed, static_cast<std::size_t>(staying_), &order);
    }
  }

  // In that order, until one has no motion, or none that arrives before
  // `latest`; its place in the order, or the number of robots.
  std::size_t Try(const Order& order, double latest, FleetAnswer* answer) {
    answer->order = order;
    answer->robots.assign(robots_.size(), {});
    answer->pairs.clear();
    answer->duration = 0.0;
    answer->status = PathStatus::kConverged;
    answer->reason.clear();
    std::vector<MovingObstacle> before;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const FleetRobot& robot = robots_[order[i]];
      PathAnswer& own = answer->robots[order[i]];
      own = Among(order[i], before);
      if (!own.is_solved) {
        answer->status = own.status;
        answer->duration = 0.0;  // not all arrive
        answer->reason = "\"" + robot.name + "\": " + own.reason;
        return i;
      }
      if (!Stays(robot)) {
        answer->duration = std::max(answer->duration, own.motion.duration());
      }
      if (answer->duration >= latest) return i;
      before.push_back(
          {robot.world.workspace().robot.Named(robot.name), own.motion});
    }
    JudgeAll(robots_, answer);
    return order.size();
  }

  PathAnswer Among(std::size_t i, const std::vector<MovingObstacle>& others) {
    if (Stays(robots_[i]) || others.empty()) return alone_[i];
    OptimizeRequest request = robots_[i].request;
    request.moving.insert(request.moving.end(), others.begin(), others.end());
    return Optimize(robots_[i].world, request);
  }

  int MostMore() const {
    int most = 0;
    for (const FleetRobot& robot : robots_) {
      most = std::max(most, MoreOrders(robot.request.preset));
    }
    return most;
  }

  // Could all arrive sooner, and has nobody ended the search?
  bool HasRoom(const FleetAnswer& answer) const {
    return !IsInterrupted() && answer.duration > kEnough * Slowest();
  }

  bool IsInterrupted() const {
    return std::any_of(
        robots_.begin(), robots_.end(), [](const FleetRobot& robot) {
          const auto& is_interrupted = robot.request.is_interrupted;
          return is_interrupted && is_interrupted();
        });
  }

  double Slowest() const {  // alone
    double slowest = 0.0;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (!Stays(robots_[i])) slowest = std::max(slowest, Alone(i));
    }
    return slowest;
  }

  static constexpr double kEnough = 1.02;  // of the slowest alone
  // Of the best by order: what ends so much later is not made faster together.
  static constexpr double kLater = 1.25;

  // The last one to arrive goes earlier: first, or so early as was not tried.
  std::optional<Order> NextOrder(const FleetAnswer& answer) {
    std::size_t last = static_cast<std::size_t>(staying_);
    for (std::size_t i = last; i < answer.order.size(); ++i) {
      if (Duration(answer, i) > Duration(answer, last)) last = i;
    }
    for (std::size_t place = static_cast<std::size_t>(staying_); place < last;
         ++place) {
      Order order = answer.order;
      ToPlace(last, place, &order);
      if (tried_.insert(order).second) return order;
    }
    return std::nullopt;
  }

  static double Duration(const FleetAnswer& answer, std::size_t place) {
    return answer.robots[answer.order[place]].motion.duration();
  }

  static void ToPlace(std::size_t from, std::size_t to, Order* order) {
    const auto at = order->begin() + static_cast<std::ptrdiff_t>(from);
    std::rotate(order->begin() + static_cast<std::ptrdiff_t>(to), at, at + 1);
  }

  const std::vector<FleetRobot>& robots_;
  std::vector<PathAnswer> alone_;
  std::ptrdiff_t staying_ = 0;
  std::set<Order> tried_;
};

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
  FleetAnswer answer = FleetSearch(robots).Run();
  answer.seconds = stopwatch.Seconds();
  return answer;
}

}  // namespace phongpd
