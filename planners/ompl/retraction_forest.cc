// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/retraction_forest.h"

#include <string>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "planners/retraction/point_neighbors.h"

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
  if (nodes_->FindTwin(target, SamePoint()) >= 0) return;
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
  const int twin = nodes_->FindTwin(path_.back(), SamePoint());
  if (twin < 0) {
    nodes_->Add(AddSlide(from));
  } else if (!graph_.AreConnected(from, twin) &&
             Slide(from, graph_.points()[static_cast<std::size_t>(twin)])) {
    AddSlide(from, twin);
  }
  return graph_.AreConnected(from, to);
}

void RetractionForest::ClearNeighbors() { nodes_->Clear(); }

}  // namespace phongpd
