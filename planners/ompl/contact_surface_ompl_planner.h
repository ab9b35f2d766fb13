// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/Planner.h>

#include <memory>
#include <string>
#include <vector>

#include "planners/exact/contact_roadmap.h"
#include "planners/exact/contact_surface_planner.h"

namespace phongpd {

// ContactSurfacePlanner as a planner of OMPL: complete and deterministic, and
// it needs no time limit.  The state space is a RealVectorStateSpace of
// dimension 3.  The space information must use the same contact space
// (MakeSpaceInformation), because the path is checked with it.
//
// Parameter `roadmap` (0 or 1, default 0): with 1, queries are answered from a
// ContactRoadmap.  The first solve() builds it; all later ones use it, also
// after clear().  For many queries in one scene.
//
// If no path exists, this is proved.  The PlannerStatus of OMPL 1.5 has no
// value for it: solve() then returns ABORT, and infeasibleProved() is true.
// ABORT with infeasibleProved() false means neither a path nor a proof;
// reason() says why.  getSpecs() says provingSolutionNonExistence.
class ContactSurfaceOmplPlanner : public ompl::base::Planner {
 public:
  ContactSurfaceOmplPlanner(
      const ompl::base::SpaceInformationPtr& si,
      std::shared_ptr<const ContactSurfacePlanner> planner);
  ~ContactSurfaceOmplPlanner() override;

  // Plans from each start to each goal of the problem until a path is found.
  // `ptc` is asked between queries only; one query takes milliseconds.
  ompl::base::PlannerStatus solve(
      const ompl::base::PlannerTerminationCondition& ptc) override;
  using Planner::solve;
  void clear() override;
  void checkValidity() override;
  // The starts and goals, and the last path found.
  void getPlannerData(ompl::base::PlannerData& data) const override;

  void setRoadmap(bool roadmap) { uses_roadmap_ = roadmap; }
  bool getRoadmap() const { return uses_roadmap_; }
  // Null until it has been built.
  const ContactRoadmap* roadmap() const { return roadmap_.get(); }

  // True if the goal has finitely many states, and each of them lies in another
  // cell of free space than each start.
  bool infeasibleProved() const { return infeasible_proved_; }
  // The planner's answer to the last query: status, certificates, counts.
  const PlanResult& result() const { return result_; }
  const std::string& reason() const { return result_.reason; }

 private:
  PlanResult Plan(const Eigen::Vector3d& start, const Eigen::Vector3d& goal);
  bool AddSolution();

  std::shared_ptr<const ContactSurfacePlanner> planner_;
  bool uses_roadmap_ = false;
  std::unique_ptr<const ContactRoadmap> roadmap_;
  std::vector<Eigen::Vector3d> starts_, goals_;
  PlanResult result_;
  bool infeasible_proved_ = false;
  std::vector<ompl::base::State*> path_;
};

}  // namespace phongpd
