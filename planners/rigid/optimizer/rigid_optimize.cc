// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/rigid_optimize.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/stopwatch.h"
#include "planners/rigid/optimizer/path_descent.h"
#include "planners/rigid/optimizer/path_starts.h"
#include "planners/rigid/optimizer/pose_rounds.h"
#include "planners/rigid/rigid_ends.h"
#include "planners/rigid/rigid_model.h"

namespace phongpd {
namespace {

using internal::PathDescentEnd;
using internal::PathDescentTask;
using internal::PoseRoundsEnd;
using internal::PoseRoundsTask;
using internal::PoseRows;
using internal::RigidStop;
using RigidPath = std::vector<RobotPose>;

constexpr int kMostKnots = 200, kMostRounds = 100;
constexpr int kRowsASample = 6;
constexpr double kMargin = 1e-3;  // of the reach
constexpr double kRange = 0.25;   // of the reach, that rows see
constexpr int kStraightIterations = 60;
// Of the time that is left.
constexpr double kStraightShare = 1.0 / 3.0, kPlannerShare = 0.9;

constexpr const char* kStartNames[] = {"both", "straight", "planner"};

class RigidOptimizer {
 public:
  RigidOptimizer(const RigidWorld& world, const RigidOptimizeRequest& request)
      : world_(world),
        request_(request),
        bounds_(internal::BoundsOf(world, request.task)),
        stop_(request.task.time_limit, request.task.is_interrupted) {}

  RigidOptimum Run() {
    RigidAnswer& answer = out_.answer;
    if (!internal::AreEndsFree(
            world_, {request_.task.start, request_.task.goal, bounds_},
            &answer)) {
      return out_;
    }
    const RigidPath line = {request_.task.start, request_.task.goal};
    const RigidCheck check =
        world_.judge().Check(RigidMotion(line[0], line[1]));
    ++answer.checks;
    answer.tests += check.tests;
    if (check.IsFree()) {
      Take(line, "line", PathStatus::kSolved);
    } else {
      if (request_.from != RigidStart::kPlanner) FromStraight();
      if (request_.from != RigidStart::kStraight && answer.path.empty()) {
        FromPlanner();
      }
      if (answer.path.empty()) SayWhy();
    }
    if (!answer.path.empty()) internal::ConfirmPath(world_, bounds_, &answer);
    return out_;
  }

 private:
  double Left() const {
    return std::max(0.0, request_.task.time_limit - stop_.Seconds());
  }

  PoseRows& Rows() {
    if (!rows_) {
      rows_.emplace(world_.model(), kRowsASample, kRange * world_.reach(),
                    request_.is_tracked);
    }
    return *rows_;
  }

  double Margin() const {
    return request_.margin > 0.0 ? request_.margin : kMargin * world_.reach();
  }

  // To a free path, or none.
  PoseRoundsEnd Free(const RigidPath& start, PoseRoundsTask task) {
    task.bounds = bounds_;
    task.margin = Margin();
    task.max_rounds = request_.max_rounds;
    const PoseRoundsEnd end =
        internal::FreePoses(world_.model(), start, task, &Rows(), &stop_);
    Count(end);
    return end;
  }

  // From a free path.
  PathDescentEnd Descend(const RigidPath& start) {
    PathDescentTask task;
    task.bounds = bounds_;
    task.margin = Margin();
    task.max_rounds = request_.max_rounds;
    const PathDescentEnd end =
        internal::DescendPath(world_.model(), start, task, &stop_);
    Count(end);
    out_.is_confirmed = end.steps > 0 || end.status == SolveStatus::kConverged;
    return end;
  }

  template <typename End>
  void Count(const End& end) {
    out_.solver = end.status;
    out_.was_refuted |= end.was_refuted;
    out_.rounds += end.rounds;
    out_.iterations += end.iterations;
    out_.samples = end.samples;
    out_.added_samples += end.added_samples;
    out_.answer.checks += end.checks;
    out_.answer.tests += end.tests;
  }

  void FromStraight() {
    if (!Rows().HasDepth()) return;  // an iterate that collides is none
    const RigidPath path = internal::StraightStart(world_, request_, bounds_);
    PoseRoundsTask task;
    double share = 1.0;
    if (request_.from == RigidStart::kBoth) {
      // What does not come off at once the planner does sooner.
      share = kStraightShare;
      task.max_iterations = kStraightIterations;
      task.max_failures = 1;
    }
    task.time_limit = share * Left();
    const PoseRoundsEnd free = Free(path, task);
    if (free.path.empty()) return;
    const PathDescentEnd end = Descend(free.path);
    Take(end.path, "straight", StatusOf(end));
  }

  void FromPlanner() {
    RigidRequest task = request_.task;
    task.time_limit = kPlannerShare * Left();
    if (!(task.time_limit > 0.0)) return;
    const RigidAnswer planned = Plan(world_, task);
    out_.answer.checks += planned.checks;
    out_.answer.tests += planned.tests;
    out_.answer.nodes = planned.nodes;
    out_.answer.found_poses = planned.found_poses;
    out_.answer.search_seconds = planned.search_seconds;
    out_.answer.search_cpu_seconds = planned.search_cpu_seconds;
    out_.answer.search_tests = planned.search_tests;
    if (!planned.IsSolved()) {
      out_.answer.status = planned.status;
      out_.answer.reason = planned.reason;
      if (planned.status == PathStatus::kTimeLimit) {
        out_.answer.reason = "the planner found no path in its share, " +
                             Rounded(task.time_limit) + " of " +
                             Rounded(request_.task.time_limit) +
                             " s, which does not prove that there is none";
      }
      return;
    }
    out_.planned_length = planned.length;
    const RigidPath start =
        internal::WithKnots(planned.path, request_.knots, world_);
    if (!IsFree(start)) {  // halves of a motion are it to rounding only
      Take(planned.path, planned.planner, PathStatus::kStalledFeasible);
      return;
    }
    const PathDescentEnd end = Descend(start);
    const bool is_shorter = end.length < planned.length;
    Take(is_shorter ? end.path : planned.path,
         is_shorter ? "planner" : planned.planner, StatusOf(end));
  }

  bool IsFree(const RigidPath& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const RigidCheck check =
          world_.judge().Check(RigidMotion(path[i], path[i + 1]));
      ++out_.answer.checks;
      out_.answer.tests += check.tests;
      if (!check.IsFree()) return false;
    }
    return true;
  }

  static PathStatus StatusOf(const PathDescentEnd& end) {
    return end.status == SolveStatus::kConverged ? PathStatus::kSolved
                                                 : PathStatus::kStalledFeasible;
  }

  void Take(const RigidPath& path, const std::string& by, PathStatus status) {
    out_.answer.path = path;
    out_.answer.planner = by;
    out_.answer.status = status;
    if (status != PathStatus::kSolved) {
      out_.answer.reason =
          "the path is proved free, but Ipopt did not converge to it";
    }
  }

  void SayWhy() {
    RigidAnswer& answer = out_.answer;
    if (!answer.reason.empty()) return;
    if (stop_.IsInterrupted()) {
      answer.status = PathStatus::kInterrupted;
    } else if (!(Left() > 0.0)) {
      answer.status = PathStatus::kTimeLimit;
    }
    answer.reason =
        rows_ && !rows_->HasDepth()
            ? "robot or obstacles are no solids, so what collides has no "
              "depth; "
              "start from the planner"
            : "no path was found that is free for all t, which does not prove "
              "that there is none";
  }

  const RigidWorld& world_;
  const RigidOptimizeRequest& request_;
  const Eigen::AlignedBox3d bounds_;
  RigidStop stop_;
  std::optional<PoseRows> rows_;
  RigidOptimum out_;
};

}  // namespace

const char* ToString(RigidStart start) {
  return kStartNames[static_cast<int>(start)];
}

RigidStart ParseRigidStart(const std::string& text, const std::string& what) {
  for (const RigidStart start :
       {RigidStart::kBoth, RigidStart::kStraight, RigidStart::kPlanner}) {
    if (text == ToString(start)) return start;
  }
  throw InputError(what + ": expected both, straight or planner, found '" +
                   text + "'");
}

void RigidOptimizeRequest::Validate() const {
  task.Validate();
  const auto require = [](bool holds, const std::string& field,
                          const std::string& expected,
                          const std::string& found) {
    if (holds) return;
    throw InputError("rigid optimize: " + field + ": expected " + expected +
                     ", found " + found);
  };
  require(knots >= 1 && knots <= kMostKnots, "knots", "1 to 200",
          std::to_string(knots));
  require(max_rounds >= 1 && max_rounds <= kMostRounds, "max_rounds",
          "1 to 100", std::to_string(max_rounds));
  require(margin >= 0.0 && std::isfinite(margin), "margin",
          "a length of 0 or more", FormatDouble(margin));
  require(start_noise >= 0.0 && start_noise <= 1.0, "start_noise",
          "a share in [0, 1]", FormatDouble(start_noise));
}

RigidOptimum Optimize(const RigidWorld& world,
                      const RigidOptimizeRequest& request) {
  request.Validate();
  const Stopwatch watch;
  RigidOptimum out = RigidOptimizer(world, request).Run();
  out.answer.seconds = watch.Seconds();
  return out;
}

}  // namespace phongpd
