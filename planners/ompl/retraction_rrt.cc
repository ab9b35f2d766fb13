// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/retraction_rrt.h"

#include <utility>

#include "planners/retraction/point_neighbors.h"

namespace phongpd {

namespace ob = ompl::base;
using Eigen::Vector3d;

RetractionRRT::RetractionRRT(const ob::SpaceInformationPtr& si,
                             std::shared_ptr<const ContactModel> model)
    : RetractionPlanner(si, std::move(model), "RetractionRRT"),
      start_tree_(std::make_unique<PointNeighbors>(&graph_)),
      goal_tree_(std::make_unique<PointNeighbors>(&graph_)) {}

RetractionRRT::~RetractionRRT() = default;

void RetractionRRT::AddRoot(int root, bool is_start) {
  PointNeighbors* own = is_start ? start_tree_.get() : goal_tree_.get();
  PointNeighbors* other = is_start ? goal_tree_.get() : start_tree_.get();
  own->Add(root);
  // Roots may see each other.
  const Vector3d q = graph_.points()[static_cast<std::size_t>(root)];
  const std::vector<int> nearest = other->Nearest(q, 1);
  if (!nearest.empty() && Slide(nearest[0], q)) AddSlide(nearest[0], root);
}

int RetractionRRT::Extend(PointNeighbors* tree, const Vector3d& target) {
  const int from = tree->Nearest(target, 1)[0];
  Slide(from, target);
  if (path_.size() < 2) return -1;
  const int twin = tree->FindTwin(path_.back(), SamePoint());
  if (twin >= 0) return twin;
  const int node = AddSlide(from);
  tree->Add(node);
  return node;
}

void RetractionRRT::Grow(const Vector3d& target,
                         const ob::PlannerTerminationCondition& ptc) {
  PointNeighbors* tree = from_start_ ? start_tree_.get() : goal_tree_.get();
  PointNeighbors* other = from_start_ ? goal_tree_.get() : start_tree_.get();
  from_start_ = !from_start_;
  const int node = Extend(tree, target);
  if (node < 0 || ptc) return;
  const Vector3d q = graph_.points()[static_cast<std::size_t>(node)];
  const int from = other->Nearest(q, 1)[0];
  if (Slide(from, q)) {
    AddSlide(from, node);
    return;
  }
  if (path_.size() < 2) return;
  if (other->FindTwin(path_.back(), SamePoint()) < 0) {
    other->Add(AddSlide(from));
  }
}

void RetractionRRT::ClearNeighbors() {
  start_tree_->Clear();
  goal_tree_->Clear();
  from_start_ = true;
}

}  // namespace phongpd
