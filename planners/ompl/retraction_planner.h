// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/goals/GoalSampleableRegion.h>

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "planners/ompl/retraction_settings.h"
#include "planners/retraction/collide_and_slide.h"
#include "planners/retraction/motion_graph.h"
#include "planners/retraction/retraction.h"

namespace phongpd {

// The common part of RetractionRRT and RetractionForest.  They draw uniform
// samples, retract those that collide, and grow a MotionGraph towards them by a
// local planner, until a start and a goal are connected.
//
// The state space must be a RealVectorStateSpace of dimension 3
// (MakeSpaceInformation), and the goal a GoalSampleableRegion.  If the space
// information has a motion validator other than a ContactSpaceMotionValidator
// of the same model, every motion must pass that one, too.  solve() goes on
// where the last call stopped.  The planner has its own random engine; its seed
// is set by setSeed, or drawn from OMPL's generator.  clear() does not reset
// the engine.
class RetractionPlanner : public ompl::base::Planner {
 public:
  ~RetractionPlanner() override;

  ompl::base::PlannerStatus solve(
      const ompl::base::PlannerTerminationCondition& ptc) override;
  using Planner::solve;
  void clear() override;
  void checkValidity() override;
  // The graph: vertices are its points, edges straight free motions.
  void getPlannerData(ompl::base::PlannerData& data) const override;

  // The clearance of the options is also the standoff of slides.
  void setRetractionOptions(const RetractionOptions& options);
  void setSeed(std::uint64_t seed);

  // Since the last clear().
  std::uint64_t samples() const { return samples_; }
  // How many samples there were when each point of graph() was added.
  const std::vector<std::uint64_t>& samplesAtPoints() const {
    return samples_at_points_;
  }
  const RetractionCounters& retractionCounters() const {
    return scratch_.counters;
  }
  const SlideCounters& slideCounters() const { return slides_; }
  const MotionGraph& graph() const { return graph_; }

 protected:
  RetractionPlanner(const ompl::base::SpaceInformationPtr& si,
                    std::shared_ptr<const ContactModel> model,
                    const std::string& name);

  // Adds a start or goal that is already point `root` of the graph.
  virtual void AddRoot(int root, bool is_start) = 0;
  // Grows the graph towards a free configuration.
  virtual void Grow(const Eigen::Vector3d& target,
                    const ompl::base::PlannerTerminationCondition& ptc) = 0;
  virtual void ClearNeighbors() = 0;

  // Moves from point `from` towards `to`; the polyline is in path_ and its
  // motions are valid.  True if it got there.
  bool Slide(int from, const Eigen::Vector3d& to);
  // Adds path_ to the graph, see MotionGraph::AddPath.
  int AddSlide(int from, int to = -1);
  int AddPoint(const Eigen::Vector3d& q);
  // Where points closer to each other than this are one.
  double SamePoint() const { return 100.0 * retraction_.model().floor(); }

  MotionGraph graph_;
  std::vector<Eigen::Vector3d> path_;
  std::vector<int> starts_, goals_;

 private:
  void DeclareParams();
  void AddInputs(const ompl::base::PlannerTerminationCondition& ptc);
  bool AddSolution();
  void FreeStates();

  Retraction retraction_;
  RetractionScratch scratch_;
  SlideCounters slides_;
  LocalPlanner local_planner_ = LocalPlanner::kCollideAndSlide;
  std::mt19937_64 random_;
  std::uint32_t seed_ = 0;
  std::uint64_t samples_ = 0;
  std::vector<std::uint64_t> samples_at_points_;
  std::vector<Eigen::Vector3d> targets_;  // of the last sample, not yet used
  bool exact_ = false;  // the motion validator is the model's own
  ompl::base::State* from_ = nullptr;
  ompl::base::State* to_ = nullptr;
  mutable std::vector<ompl::base::State*> states_;  // for planner data
};

}  // namespace phongpd
