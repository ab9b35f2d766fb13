// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/retraction_forest.h"

#include <string>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "planners/ompl/point_neighbors.h"

namespace phongpd {

namespace ob = ompl::base;
using Eigen::Vector3d;

RetractionForest::RetractionForest(const ob::SpaceInformationPtr& si,
                                   std::shared_ptr<const ContactModel> model)
    : RetractionPlanner(si, std::move(model), "RetractionForest"),
      nodes_(std::make_unique<PointNeighbors>(&graph_)) {
  declareParam<unsigned int>(
      "max_nearest_neighbors", this, &RetractionForest::setMaxNearestNeighbors,
      &RetractionForest::getMaxNearestNeighbors, "3:1:12");
}

RetractionForest::~RetractionForest() = default;

void RetractionForest::setMaxNearestNeighbors(unsigned int k) {
  if (k < 1) {
    throw InputError("max_nearest_neighbors: expected ≥ 1, found " +
                     std::to_string(k));
  }
  neighbors_ = k;
}

void RetractionForest::AddRoot(int root, bool) { Connect(root, nullptr); }

void RetractionForest::Grow(const Vector3d& target,
                            const ob::PlannerTerminationCondition& ptc) {
  const std::vector<int>& twin = nodes_->Nearest(target, 1);
  if (!twin.empty()) {
    const Vector3d& there = graph_.points()[static_cast<std::size_t>(twin[0])];
    if ((there - target).norm() <= SamePoint()) return;
  }
  Connect(AddPoint(target), &ptc);
}

void RetractionForest::Connect(int node,
                               const ob::PlannerTerminationCondition* ptc) {
  nearest_ = nodes_->Nearest(graph_.points()[static_cast<std::size_t>(node)],
                             neighbors_);
  nodes_->Add(node);
  for (const int neighbor : nearest_) {
    if (ptc != nullptr && *ptc) return;
    if (graph_.AreConnected(node, neighbor)) continue;
    if (Join(node, neighbor)) continue;
    if (ptc != nullptr && *ptc) return;
    Join(neighbor, node);
  }
}

bool RetractionForest::Join(int from, int to) {
  const Vector3d target = graph_.points()[static_cast<std::size_t>(to)];
  if (Slide(from, target)) {
    AddSlide(from, to);
    return true;
  }
  if (path_.size() < 2) return false;
  const Vector3d end = path_.back();
  const int twin = nodes_->Nearest(end, 1)[0];
  const Vector3d& there = graph_.points()[static_cast<std::size_t>(twin)];
  if ((there - end).norm() > SamePoint()) {
    nodes_->Add(AddSlide(from));
  } else if (!graph_.AreConnected(from, twin) && Slide(from, there)) {
    AddSlide(from, twin);
  }
  return graph_.AreConnected(from, to);
}

void RetractionForest::ClearNeighbors() { nodes_->Clear(); }

}  // namespace phongpd
