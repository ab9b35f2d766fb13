// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "constraints/trajectory.h"
#include "core/contact/free_space_flood.h"
#include "core/projection/window_use.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/verification.h"
#include "planners/ompl/ompl_planning.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/trajectory/trajectory_pipeline.h"
#include "planners/world/model.h"
#include "planners/world/path_status.h"
#include "planners/world/planner_id.h"
#include "planners/world/world.h"

namespace phongpd {

// The evidence for an answer.
struct PathEvidence {
  // The model in which it was found and judged, kFull or kWindow; none: the
  // answer was known before anything was built.
  std::optional<Model> model;
  std::shared_ptr<const FreeSpace> free_space;  // its judge; null: none
  // Why Model::kAuto had to take the window, and why a metric could not be had
  // from windows; empty: it did not have to, and it could.
  std::string refusal;
  // The exact judge's word on the path: free, or the first crossing.
  PathCheck check;
  // Of a motion, upper bounds of what it asks of its limits, for all t.
  LimitUse use;
  // What contact-surface explored in a window; for a proof, the cell that is
  // enclosed.  None: a proof rests on the world's sealed space, or the straight
  // way was enough.
  std::optional<ExploredSpace> surface;
  // The second judgement, by other code on the original solids
  // (verification.h); none: nobody asked, or there was nothing to judge.
  std::optional<Verification> verification;
  double verification_seconds = 0.0;
};

// The clearance that was asked for, and what the path lacks of it.
struct ClearanceAnswer {
  std::optional<ResolvedLength> asked;  // none: nothing
  // User's unit; none: without a path, or nothing was asked for.
  std::optional<double> shortfall;
};

// How a planner came to its path.
struct PlanWork {
  PlannerId planner = PlannerId::kContactSurface;
  // The options of contact-surface, and the routes that it compared, one of
  // which is the path; none: another planner ran, or none did.
  std::optional<ContactSurfaceOptions> surface;
  std::vector<Path> routes;
  // What contact-surface explored in the window; none: it did not run there.
  std::optional<std::size_t> explored_boxes, explored_faces;
  // The clearance sought; none: the planner seeks none, or did not start.
  std::optional<ResolvedLength> wanted_clearance;
  // Counts and trees of a sampler and its own path; of contact-surface, its
  // tests of motions.
  OmplPlanningResult search;
};

// What Plan and Optimize answer.  No member is NaN or infinite.
struct PathAnswer {
  PathStatus status = PathStatus::kFailed;
  std::string reason;  // one sentence where the status needs one
  // From start to goal; for a motion in time, the path that it began with.
  // Empty: none.
  Path path;
  // In time, if limits were given; empty: none.
  Trajectory motion;

  bool is_free = false;    // path or motion, by the exact judge
  bool is_solved = false;  // free, and all that was asked for is kept
  bool IsInfeasible() const { return status == PathStatus::kInfeasibleProved; }

  double length = 0.0;     // of the path, or of the motion; user's unit
  double clearance = 0.0;  // of all of it, 0 where it is not free; user's unit
  ClearanceAnswer wish;
  double seconds = 0.0;  // without building and verification
  int routes = 0;        // ways that a motion was sought along

  PathEvidence evidence;

  // For rows, pictures and studies: what ran.
  std::optional<PlanWork> plan;
  std::optional<PipelineResult> pipeline;  // of Optimize without limits
  std::optional<CurveSummary> curve;       // of Optimize with limits
  // What of C_cont the metric took that Ipopt followed in a window; none: it
  // followed the whole, or free space alone was modelled and no metric.
  std::optional<WindowUse> windows;
};

}  // namespace phongpd
