// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "problems/pictures/viewer/view.h"
#include "problems/studies/planning_study.h"
#include "problems/studies/trajectory_study.h"

namespace phongpd {

// What lies behind the answer of a run, for its page; nothing where the run has
// nothing of the kind.
//
// What the planner grew: trees, a roadmap, or the routes that contact-surface
// compared.  Call it before the study's next run.
ViewBehind BehindPlan(const PlanningStudy& study, const PlanningResult& result);

// The planes of the corridor that the path was optimised in.
ViewBehind BehindTrajectory(const TrajectoryStudy& study,
                            const PipelineResult& result);

}  // namespace phongpd
