// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "planners/ompl/retraction_planner.h"

namespace phongpd {

class PointNeighbors;

// RRT-Connect with retracted samples and slides: for problems with narrow
// passages.  One tree grows from the starts and one from the goals, along
// obstacles (collide_and_slide.h).
//
// Each retracted sample is a target.  The nearest node of one tree slides
// towards it, and the end of the slide becomes a node.  Then the nearest node
// of the other tree slides towards that new node, and the trees change roles.
// A slide goes as far as it can: there is no step length to choose.
class RetractionRRT : public RetractionPlanner {
 public:
  RetractionRRT(const ompl::base::SpaceInformationPtr& si,
                std::shared_ptr<const ContactModel> model);
  ~RetractionRRT() override;

 protected:
  void AddRoot(int root, bool is_start) override;
  void Grow(const Eigen::Vector3d& target,
            const ompl::base::PlannerTerminationCondition& ptc) override;
  void ClearNeighbors() override;

 private:
  // The new node, or −1.
  int Extend(PointNeighbors* tree, const Eigen::Vector3d& target);

  std::unique_ptr<PointNeighbors> start_tree_, goal_tree_;
  bool from_start_ = true;  // the tree that is extended next
};

}  // namespace phongpd
