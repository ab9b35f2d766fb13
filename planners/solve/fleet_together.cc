// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/fleet_together.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "constraints/moving_judge.h"
#include "core/mesh/triangle_mesh.h"
#include "planners/solve/optimize_in_time.h"
#include "planners/trajectory/joint_curves.h"
#include "planners/trajectory/joint_turns.h"

namespace phongpd::internal {
namespace {

bool Stays(const FleetRobot& robot) {
  return robot.request.start == robot.request.goal && robot.request.via.empty();
}

JointTask TaskOf(const std::vector<FleetRobot>& robots,
                 const FleetAnswer& answer, double wanted) {
  JointTask task;
  task.wanted = wanted;
  task.time_limit = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const FleetRobot& robot = robots[i];
    const CurveOptions options = CurveOptionsOf(robot.world, robot.request);
    task.time_limit = std::min(task.time_limit, options.time_limit);
    if (options.preset == Preset::kTight) task.halvings = 1;
    if (options.is_interrupted) task.is_interrupted = options.is_interrupted;
    const PathAnswer& own = answer.robots[i];
    // Rows let a little of the margin go.
    constexpr double kMore = 1.03;
    const double required =
        robot.request.requires_margin ? options.margin : 0.0;
    task.robots.push_back({own.evidence.free_space, options.limits,
                           std::max(options.margin, kMore * required), required,
                           robot.world.diagonal(), own.motion, Stays(robot),
                           MovingBodies(robot.world, robot.request.moving),
                           options.via});
    for (std::size_t k = 0; k < i; ++k) {
      if (Stays(robot) && Stays(robots[k])) continue;
      const FleetRobot& other = robots[k];
      const MovingObstacle body = {
          other.world.workspace().robot.Named(other.name),
          answer.robots[k].motion};
      task.pairs.push_back({static_cast<int>(i), static_cast<int>(k),
                            MovingBodies(robot.world, {body}).front().space});
    }
  }
  return task;
}

void Replace(const FleetRobot& robot, const Trajectory& motion,
             PathAnswer* answer) {
  const CurveOptions options = CurveOptionsOf(robot.world, robot.request);
  CurveSummary& curve = *answer->curve;
  answer->motion = curve.trajectory = motion;
  curve.duration = motion.duration();
  // There is no more than a search behind it.
  answer->status = curve.status = PathStatus::kRoundLimit;
  answer->length = motion.ArcLength();
  answer->clearance = curve.clearance = curve.margin = ProvedClearance(
      *answer->evidence.free_space,
      MovingBodies(robot.world, robot.request.moving), motion, options.margin);
  answer->evidence.use = BoundLimitUse(motion, options.limits);
  if (!robot.request.verifies) return;
  answer->evidence.verification =
      Verifier(robot.world.workspace()).VerifyCurve(motion);
}

// The answer with these motions; none: one is refuted on the solids.
std::optional<FleetAnswer> With(const std::vector<FleetRobot>& robots,
                                const JointMotions& joint,
                                const FleetAnswer& answer) {
  if (joint.motions.empty()) return std::nullopt;
  FleetAnswer hastened = answer;
  hastened.pairs.clear();
  hastened.duration = joint.motions.front().duration();
  hastened.rounds_together = joint.rounds;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (Stays(robots[i])) continue;
    PathAnswer& own = hastened.robots[i];
    Replace(robots[i], joint.motions[i], &own);
    const auto& verification = own.evidence.verification;
    if (verification && verification->verdict == Verdict::kRefuted) {
      return std::nullopt;
    }
  }
  return hastened;
}

// Lanes about as wide as the robots, and wider: the narrowest one at which
// motions keep off each other is enough.
constexpr double kFirstLane = 0.5;  // of the largest robot
constexpr double kWider = 1.3;
constexpr int kLanes = 10;

double LargestRobot(const std::vector<FleetRobot>& robots) {
  double largest = 0.0;
  for (const FleetRobot& robot : robots) {
    const BoundingBox box = ComputeBounds(robot.world.workspace().robot.mesh());
    largest = std::max(largest, (box.max - box.min).norm());
  }
  return largest;
}

}  // namespace

std::optional<FleetAnswer> Hastened(const std::vector<FleetRobot>& robots,
                                    const FleetAnswer& answer, double wanted) {
  if (robots.size() < 2) return std::nullopt;
  return With(robots, HastenTogether(TaskOf(robots, answer, wanted)), answer);
}

std::optional<FleetAnswer> HastenedInTurns(
    const std::vector<FleetRobot>& robots, const FleetAnswer& answer,
    double wanted) {
  const bool goes_its_way =
      std::all_of(robots.begin(), robots.end(), [](const FleetRobot& robot) {
        return robot.request.via.empty() && robot.request.moving.empty();
      });
  if (robots.size() < 2 || !goes_its_way) return std::nullopt;
  JointTask task = TaskOf(robots, answer, wanted);
  double lane = kFirstLane * LargestRobot(robots);
  for (int i = 0; i < kLanes; ++i) {
    const std::vector<Trajectory> motions = TurnedMotions(task.robots, lane);
    for (std::size_t c = 0; c < motions.size(); ++c) {
      task.robots[c].motion = motions[c];
    }
    const JointMotions joint = HastenTogether(task);
    if (joint.rounds > 0) return With(robots, joint, answer);
    lane *= kWider;
  }
  return std::nullopt;
}

}  // namespace phongpd::internal
