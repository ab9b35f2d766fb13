// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/Planner.h>

#include <memory>
#include <string>

#include "planners/ompl/ompl_planning.h"

namespace phongpd {

// A planner by one of OmplPlannerNames, for a space information as
// MakeSpaceInformation makes it (whose valid-state sampler it sets where the
// name says so).  For ompl::tools::Benchmark and for programs that use OMPL
// themselves.  One space information holds one valid-state sampler: give each
// prm-* planner its own.  Throws InputError.
ompl::base::PlannerPtr MakeOmplPlanner(
    const std::string& name, const ompl::base::SpaceInformationPtr& si,
    const std::shared_ptr<const ContactModel>& model,
    const OmplPlanningOptions& options = {});

}  // namespace phongpd
