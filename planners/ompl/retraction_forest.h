// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "planners/ompl/retraction_planner.h"

namespace phongpd {

class PointNeighbors;

// A sampling-based planner for narrow passages: a roadmap without cycles.  Each
// retracted sample is the root of a new tree.  Slides (collide_and_slide.h)
// between a new node and its k nearest nodes, in both directions, join trees.
// Where a slide stops on its way, its end becomes a node too; so a tree grows
// on from every point that lies in a passage.  RetractionRRT keeps only two
// trees.
class RetractionForest : public RetractionPlanner {
 public:
  RetractionForest(const ompl::base::SpaceInformationPtr& si,
                   std::shared_ptr<const ContactModel> model);
  ~RetractionForest() override;

  // k ≥ 1, by default 6.  Values from 3 to 12 do equally well, except in mazes,
  // where more is better.
  void setMaxNearestNeighbors(unsigned int k);
  unsigned int getMaxNearestNeighbors() const { return neighbors_; }

 protected:
  void AddRoot(int root, bool is_start) override;
  void Grow(const Eigen::Vector3d& target,
            const ompl::base::PlannerTerminationCondition& ptc) override;
  void ClearNeighbors() override;

 private:
  void Connect(int node, const ompl::base::PlannerTerminationCondition* ptc);
  bool Join(int from, int to);

  unsigned int neighbors_ = 6;
  std::unique_ptr<PointNeighbors> nodes_;
  std::vector<int> nearest_;
};

}  // namespace phongpd
