// SPDX-License-Identifier: GPL-3.0-or-later
// Headers of the component ompl, and something of it that must link.
#include <phongpd/planners/ompl/contact_space_validity.h>
#include <phongpd/planners/ompl/contact_surface_ompl_planner.h>
#include <phongpd/planners/ompl/ompl_planners.h>
#include <phongpd/planners/ompl/retraction_forest.h>
#include <phongpd/planners/ompl/retraction_rrt.h>
#include <phongpd/planners/ompl/retraction_state_sampler.h>

ompl::base::PlannerPtr MakePlanner(
    const std::shared_ptr<const phongpd::ContactModel>& model) {
  return phongpd::MakeOmplPlanner("retraction-rrt",
                                  phongpd::MakeSpaceInformation(model), model);
}
