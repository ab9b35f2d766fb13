// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "planners/ompl/motion_domain.h"
#include "planners/trajectory/trajectory_pipeline.h"

namespace phongpd {

// One way from start to goal by rrt-connect, shortened; exactly free, of
// waypoints + 2 points.  None found: the path is empty, for a reason, which is
// no proof.
struct SearchedWay {
  Path path;
  std::string reason;
  double seconds = 0.0;
};
SearchedWay SearchWay(const TrajectoryProblem& problem,
                      const MotionDomain& domain, double planner_seconds,
                      std::uint64_t seed);

// The trajectory pipeline where free space is all that is known (model
// window): no penetration metric, so nothing leads out of a collision.
//
//   line, or rrt-connect and shortening where it collides → corridor → judge
//
// for each of options.routes, by consecutive seeds; the best path wins as in
// TrajectoryPipeline.  The corridor (corridor.h) needs no more than free space
// and is the same optimiser as there; its local minimum is that of the way the
// first path takes.  What options say of Ipopt's own solve does not count.
// `planner_seconds` > 0 is each search's limit.  A search that finds nothing
// proves nothing: status kFailed, never kInfeasibleProved.
//
// problem.free_space is that of the domain; its metrics are empty.  Throws
// InputError for bad options and problems.
PipelineResult OptimizeInFreeSpace(const TrajectoryProblem& problem,
                                   const MotionDomain& domain,
                                   const PipelineOptions& options,
                                   double planner_seconds);

}  // namespace phongpd
