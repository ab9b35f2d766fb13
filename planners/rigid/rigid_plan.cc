// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/rigid_plan.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <string>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/stopwatch.h"
#include "planners/rigid/object_norm.h"
#include "planners/rigid/rigid_ends.h"
#include "planners/rigid/rigid_model.h"
#include "planners/rigid/rigid_race.h"
#include "planners/rigid/rigid_shortening.h"
#include "planners/rigid/tree_search.h"

namespace phongpd {
namespace {

using internal::RigidLinks;
using internal::RigidModel;
using internal::RigidStop;
using internal::TreeTask;

constexpr double kMaxTimeLimit = 1e9;
constexpr int kMostThreads = 64;
// Who found a path at once waits no longer for its shortening than for it; a
// few milliseconds at least, which leave little to be cut where there is room.
constexpr long kLeastShorteningTests = 20'000;

// Of all threads of the process, ours among them.
double ProcessorSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

class RigidPlanner {
 public:
  RigidPlanner(const RigidModel& model, const RigidRequest& request,
               const TreeTask& task)
      : model_(model),
        request_(request),
        task_(task),
        stop_(request.time_limit, request.is_interrupted),
        links_(model.judge, &stop_) {}

  void Run(RigidAnswer* answer) {
    const double begin = ProcessorSeconds();
    std::uint64_t seed = request_.seed;
    if (links_.IsFree(task_.start, task_.goal)) {
      answer->path = {task_.start, task_.goal};
      answer->planner = "line";
    } else {
      internal::RaceEnd race = internal::RacePortfolios(
          model_, task_, request_.seed, request_.threads, &stop_);
      answer->path = std::move(race.path);
      answer->planner = race.planner;
      answer->checks += race.checks;
      answer->tests += race.tests;
      answer->nodes += race.nodes;
      seed = race.seed;
    }
    answer->search_seconds = stop_.Seconds();
    answer->search_cpu_seconds = ProcessorSeconds() - begin;
    answer->search_tests = answer->tests + links_.tests();
    answer->found_poses = answer->path.size();
    if (request_.shortens && answer->path.size() > 2) {
      std::mt19937_64 random(seed);
      internal::ShortenRigidPath(
          model_.gyration,
          std::max(answer->search_tests, kLeastShorteningTests), &links_,
          &random, &answer->path);
    }
    answer->checks += links_.checks();
    answer->tests += links_.tests();
    if (answer->path.empty()) SayWhy(answer);
  }

 private:
  void SayWhy(RigidAnswer* answer) const {
    answer->status = stop_.IsInterrupted() ? PathStatus::kInterrupted
                                           : PathStatus::kTimeLimit;
    answer->reason = std::string("no path was found ") +
                     (stop_.IsInterrupted()
                          ? "before the caller ended the search"
                          : "within " + Rounded(request_.time_limit) + " s") +
                     ", which does not prove that there is none";
  }

  const RigidModel& model_;
  const RigidRequest& request_;
  const TreeTask& task_;
  RigidStop stop_;
  RigidLinks links_;
};

RigidAnswer PlanTask(const RigidWorld& world, const RigidRequest& request,
                     bool turns) {
  const Stopwatch watch;
  RigidAnswer answer;
  const TreeTask task{request.start, request.goal,
                      internal::BoundsOf(world, request), turns};
  if (internal::AreEndsFree(world, task, &answer)) {
    RigidPlanner(world.model(), request, task).Run(&answer);
    if (!answer.path.empty() &&
        internal::ConfirmPath(world, task.bounds, &answer)) {
      answer.status = PathStatus::kSolved;
    }
  }
  answer.seconds = watch.Seconds();
  return answer;
}

}  // namespace

void RigidRequest::Validate() const {
  CheckPose(start, "rigid request: start");
  CheckPose(goal, "rigid request: goal");
  if (!(time_limit > 0.0 && time_limit <= kMaxTimeLimit)) {
    throw InputError(
        "rigid request: time_limit: expected seconds in (0, 1e9], found " +
        FormatDouble(time_limit));
  }
  if (!(threads >= 1 && threads <= kMostThreads)) {
    throw InputError("rigid request: threads: expected 1 to 64, found " +
                     std::to_string(threads));
  }
  const Eigen::AlignedBox3d untouched;
  const bool is_default =
      bounds.min() == untouched.min() && bounds.max() == untouched.max();
  if (is_default) return;
  if (bounds.isEmpty()) {
    throw InputError(
        "rigid request: bounds: expected min <= max on every axis, found " +
        FormatPoint(bounds.min()) + " and " + FormatPoint(bounds.max()) +
        "; swap them, or leave them out for a box around the obstacles");
  }
  if (!(bounds.min().allFinite() && bounds.max().allFinite())) {
    throw InputError(
        "rigid request: bounds: expected finite corners, found NaN or "
        "infinity; leave them out for a box around the obstacles");
  }
}

RigidAnswer Plan(const RigidWorld& world, const RigidRequest& request) {
  request.Validate();
  return PlanTask(world, request, true);
}

RigidAnswer PlanWithoutTurning(const RigidWorld& world,
                               const RigidRequest& request) {
  request.Validate();
  const Eigen::Vector4d& first = request.start.orientation.coeffs();
  const Eigen::Vector4d& last = request.goal.orientation.coeffs();
  if (first != last) {
    throw InputError(
        "rigid request: goal: expected to be turned as the start, found " +
        FormatPoint(last.head<3>()) + ',' + FormatDouble(last.w()) + " and " +
        FormatPoint(first.head<3>()) + ',' + FormatDouble(first.w()) +
        " (x,y,z,w); let it turn, or turn the meshes");
  }
  return PlanTask(world, request, false);
}

}  // namespace phongpd
