// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/Planner.h>

#include <memory>
#include <string>
#include <vector>

#include "planners/exact/contact_roadmap.h"
#include "planners/exact/contact_surface_planner.h"

namespace phongpd {

// ContactSurfacePlanner as a planner of OMPL: complete and deterministic; it
// answers at once and needs no time limit.  The state space is a
// RealVectorStateSpace of dimension 3; the space information must judge by the
// same contact space (MakeSpaceInformation), as the path is checked with it.
//
// Parameter `roadmap` (0 or 1, default 0): answer from a ContactRoadmap, which
// the first solve() builds and all later ones use, also after clear().  For
// many queries on one scene.
//
// Where no path exists it proves so.  PlannerStatus of OMPL 1.5 has no word
// for that: solve() returns ABORT ("the planner did not find a solution for
// some other reason") and infeasibleProved() is true; getSpecs() says
// provingSolutionNonExistence.  ABORT with infeasibleProved() false: neither
// path nor proof, reason() says why.
class ContactSurfaceOmplPlanner : public ompl::base::Planner {
 public:
  ContactSurfaceOmplPlanner(
      const ompl::base::SpaceInformationPtr& si,
      std::shared_ptr<const ContactSurfacePlanner> planner);
  ~ContactSurfaceOmplPlanner() override;

  // Plans from every start to every goal the problem offers until a path is
  // found.  Not interrupted by ptc within one query (milliseconds).
  ompl::base::PlannerStatus solve(
      const ompl::base::PlannerTerminationCondition& ptc) override;
  using Planner::solve;
  void clear() override;
  void checkValidity() override;
  // Starts and goals, and the path found last.
  void getPlannerData(ompl::base::PlannerData& data) const override;

  void setRoadmap(bool roadmap) { uses_roadmap_ = roadmap; }
  bool getRoadmap() const { return uses_roadmap_; }
  // Null until it has been built.
  const ContactRoadmap* roadmap() const { return roadmap_.get(); }

  // Every goal seen, of a goal that has finitely many, lies in another cell of
  // free space than every start.
  bool infeasibleProved() const { return infeasible_proved_; }
  // Of the last query; status, certificates and counts.
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
