// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/ProblemDefinition.h>

#include <Eigen/Core>
#include <memory>
#include <string>

#include "planners/ompl/ompl_planning.h"

namespace phongpd {

// Gives the problem one start and one goal.  Throws InputError for a point that
// is not finite.
void SetStartAndGoal(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                     ompl::base::ProblemDefinition* problem);

// Any planner but contact-surface, for a space information as
// MakeSpaceInformation makes it (whose valid-state sampler it sets where the
// name says so).  For ompl::tools::Benchmark and for programs that use OMPL
// themselves.  One space information holds one valid-state sampler: give each
// prm-* planner its own.  The model may be null for those
// that do not retract.  Throws InputError.
ompl::base::PlannerPtr MakeOmplPlanner(
    PlannerId planner, const ompl::base::SpaceInformationPtr& si,
    const std::shared_ptr<const ContactModel>& model,
    const OmplPlanningOptions& options = {});

}  // namespace phongpd
