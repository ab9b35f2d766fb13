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

// OMPL's planners on a contact model, or on free space alone, without a type of
// OMPL's.
namespace phongpd {

struct OmplPlanningOptions {
  double time_limit = 1.0;  // seconds, in (0, 1e9]
  // Of every random engine of the run.  Runs with the same seed repeat, up to
  // when time runs out, if no two runs overlap in one process: OMPL's own
  // generator is global and is reseeded here.  PRM watches its roadmap from a
  // second thread and repeats only up to when that one notices a solution.
  std::uint64_t seed = 1;
  RetractionOptions retraction;  // retraction-* and prm-retraction

  // Throws InputError.
  void Validate() const;
};

// What a planner grew: configurations, and the straight free motions between
// them by their numbers.  OMPL does not promise an order.
struct GrownGraph {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::pair<int, int>> edges;
  // retraction-rrt and -forest: how many uniform samples there were when each
  // point was added, in this order.  Empty for OMPL's own planners.
  std::vector<std::uint64_t> samples;
};

struct OmplPlanningResult {
  bool solved = false;          // what the planner claims
  bool collision_free = false;  // CheckPath's word on the path
  std::string status;           // of OMPL's planner
  std::vector<Eigen::Vector3d> path;
  double length = 0.0;
  double clearance = 0.0;  // of the whole path from contact; 0 if none is free
  std::uint64_t samples = 0;  // uniform ones; 0 for OMPL's own planners
  std::uint64_t collision_checks = 0;  // of a configuration
  std::uint64_t segment_checks = 0;    // of a motion
  std::uint64_t retractions = 0;       // of colliding configurations
  std::uint64_t branch_ends = 0;
  GrownGraph graph;
  double seconds = 0.0;  // of the planner alone
};

// One run of any planner but contact-surface, all with the exact motion
// validator.  Throws InputError for that one, bad options, a missing model or a
// start or goal that is not finite; a start or goal in collision is a status
// ("Invalid start", "Invalid goal").  OMPL's log is not touched; SilenceOmpl
// turns it off.  CancelBuilds stops it: BuildCancelled.
OmplPlanningResult PlanWithOmpl(
    const std::shared_ptr<const ContactModel>& model,
    const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
    PlannerId planner, const OmplPlanningOptions& options = {});

// The same by a planner that does not retract; throws InputError for others.
OmplPlanningResult PlanWithOmpl(const MotionDomain& domain,
                                const Eigen::Vector3d& start,
                                const Eigen::Vector3d& goal, PlannerId planner,
                                const OmplPlanningOptions& options = {});

// Runs ompl::tools::Benchmark on one planner and returns its log, which
// ompl_benchmark_statistics.py reads; the host is not named.  Its clock ticks
// every 0.1 s: PlanWithOmpl measures better.  Throws InputError.
std::string OmplBenchmarkLog(const std::shared_ptr<const ContactModel>& model,
                             const Eigen::Vector3d& start,
                             const Eigen::Vector3d& goal,
                             const std::string& experiment, PlannerId planner,
                             int runs, const OmplPlanningOptions& options = {});
// The same by a planner that does not retract; throws InputError for others.
std::string OmplBenchmarkLog(const MotionDomain& domain,
                             const Eigen::Vector3d& start,
                             const Eigen::Vector3d& goal,
                             const std::string& experiment, PlannerId planner,
                             int runs, const OmplPlanningOptions& options = {});

// Of the OMPL this was compiled with, "1.5.2".
std::string OmplVersion();

// Turns OMPL's console log off, errors included.
void SilenceOmpl();

}  // namespace phongpd
