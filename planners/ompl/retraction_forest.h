// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "planners/ompl/retraction_planner.h"

namespace phongpd {

class PointNeighbors;

// A roadmap without cycles: every retracted sample is the root of a tree, and
// trees are joined by slides, in both directions, between a new node and its k
// nearest.  The end of a slide that stops becomes a node as well, so trees
// grow into passages from whatever point lies in them.
class RetractionForest : public RetractionPlanner {
 public:
  RetractionForest(const ompl::base::SpaceInformationPtr& si,
                   std::shared_ptr<const ContactModel> model);
  ~RetractionForest() override;

  // k ≥ 1; 6 by default (3 to 12 make no difference but in mazes, where more
  // is better).
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
