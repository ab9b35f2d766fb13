// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "planners/trajectory/path_history.h"
#include "viewer/view.h"

namespace phongpd {

// What lies behind an answer, for its page; nothing where there is nothing of
// the kind.
//
// What the planner grew: trees, a roadmap, or the routes that contact-surface
// compared; and the window that it searched, where free space alone was
// modelled.
ViewBehind BehindPlan(const World& world, const PlanRequest& request,
                      const PathAnswer& answer);

// The planes of the corridor that the polyline was optimised in, the iterations
// of the run, each judged, and the window as BehindPlan.
ViewBehind BehindTrajectory(const World& world, const OptimizeRequest& request,
                            const PathAnswer& answer,
                            const PathHistory& history);

// The triangles of a contact space, or of what was explored of one, that lie in
// a box, without walls that are none of contact.
TriangleMesh VisibleMesh(const ContactSpace& space, const BoundingBox& region);

}  // namespace phongpd
