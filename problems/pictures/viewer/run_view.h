// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planners/trajectory/path_history.h"
#include "problems/pictures/viewer/view.h"
#include "problems/studies/planning_study.h"
#include "problems/studies/trajectory_study.h"

namespace phongpd {

// What lies behind the answer of a run, for its page; nothing where the run has
// nothing of the kind.
//
// What the planner grew: trees, a roadmap, or the routes that contact-surface
// compared; and the window that it searched, where free space alone was
// modelled.  Call it before the study's next run.
ViewBehind BehindPlan(PlanningStudy* study, const PlanningResult& result);

// The planes of the corridor that the path was optimised in, the iterations of
// the run, each judged, and the window as BehindPlan.
ViewBehind BehindTrajectory(const TrajectoryStudy& study,
                            const PipelineResult& result,
                            const PathHistory& history);

}  // namespace phongpd
