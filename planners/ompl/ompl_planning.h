// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "planners/ompl/motion_domain.h"
#include "planners/retraction/retraction.h"
#include "planners/world/planner_id.h"

// Runs OMPL's planners by name on a contact model, or on free space alone.  No
// type of OMPL appears here, so that callers need not include OMPL.
namespace phongpd {

struct OmplPlanningOptions {
  double time_limit = 1.0;  // seconds, in (0, 1e9]
  // Seed of all random engines of the run.  Two runs with the same seed do the
  // same, until time runs out.  Two exceptions: runs that overlap in one
  // process, because OMPL's own generator is global and is reseeded here; and
  // PRM, whose second thread decides when a solution is noticed.
  std::uint64_t seed = 1;
  RetractionOptions retraction;  // retraction-* and prm-retraction

  // Throws InputError.
  void Validate() const;
};

// The tree or roadmap of a planner: configurations, and the straight free
// motions between them as pairs of indices.  OMPL promises no order.
struct GrownGraph {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::pair<int, int>> edges;
  // For retraction-rrt and retraction-forest: the number of uniform samples
  // drawn when each point was added.  Empty for OMPL's own planners.
  std::vector<std::uint64_t> samples;
};

struct OmplPlanningResult {
  bool solved = false;          // the planner's claim
  bool collision_free = false;  // CheckPath's judgement of the path
  std::string status;           // in the words of OMPL's PlannerStatus
  bool is_late = false;         // not solved, or only nearly, when time was up
  std::vector<Eigen::Vector3d> path;
  double length = 0.0;  // user's unit
  // The path's smallest distance from contact, user's unit; 0 if not free.
  double clearance = 0.0;
  std::uint64_t samples = 0;  // uniform ones; 0 for OMPL's own planners
  std::uint64_t collision_checks = 0;  // of configurations
  std::uint64_t segment_checks = 0;    // of motions
  std::uint64_t retractions = 0;       // of colliding configurations
  std::uint64_t branch_ends = 0;       // RetractionCounters::branch_ends
  GrownGraph graph;
  double seconds = 0.0;  // of the planner alone
};

// One run of one planner, any but contact-surface, with the exact validators of
// contact_space_validity.h.  Throws InputError for contact-surface, bad
// options, a missing model, and a start or goal that is not finite.  A start or
// goal in collision is a status ("Invalid start", "Invalid goal").  OMPL writes
// its log to the console; SilenceOmpl turns that off.
// CancelBuilds stops it: BuildCancelled.
OmplPlanningResult PlanWithOmpl(
    const std::shared_ptr<const ContactModel>& model,
    const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
    PlannerId planner, const OmplPlanningOptions& options = {});

// The same for planners that do not retract; throws InputError for those that
// do.
OmplPlanningResult PlanWithOmpl(const MotionDomain& domain,
                                const Eigen::Vector3d& start,
                                const Eigen::Vector3d& goal, PlannerId planner,
                                const OmplPlanningOptions& options = {});

// Runs ompl::tools::Benchmark on one planner, and returns its log for
// ompl_benchmark_statistics.py, without the host's name.  It measures time in
// steps of 0.1 s only; PlanWithOmpl is more precise.  Throws InputError like
// PlanWithOmpl.
std::string OmplBenchmarkLog(const std::shared_ptr<const ContactModel>& model,
                             const Eigen::Vector3d& start,
                             const Eigen::Vector3d& goal,
                             const std::string& experiment, PlannerId planner,
                             int runs, const OmplPlanningOptions& options = {});
// The same for planners that do not retract; throws InputError for those that
// do.
std::string OmplBenchmarkLog(const MotionDomain& domain,
                             const Eigen::Vector3d& start,
                             const Eigen::Vector3d& goal,
                             const std::string& experiment, PlannerId planner,
                             int runs, const OmplPlanningOptions& options = {});

// The version of OMPL that this was compiled with, such as "1.5.2".
std::string OmplVersion();

// Turns OMPL's log on the console off, errors too.
void SilenceOmpl();

}  // namespace phongpd
