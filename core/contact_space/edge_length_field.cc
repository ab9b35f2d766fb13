// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/edge_length_field.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

constexpr double kSlope = 0.5;
constexpr int kLeafSize = 4;

double SquaredDistance(const EdgeLengthField::Segment& segment,
                       const Eigen::Vector3d& x) {
  const Eigen::Vector3d along = segment.second - segment.first;
  const Eigen::Vector3d to = x - segment.first;
  const double length = along.squaredNorm();
  const double t =
      length > 0.0 ? std::clamp(to.dot(along) / length, 0.0, 1.0) : 0.0;
  return (to - t * along).squaredNorm();
}

}  // namespace

EdgeLengthField::EdgeLengthField(const std::vector<Segment>& sharp_edges,
                                 double longest, double fraction)
    : largest_(longest), least_(fraction * longest) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(sharp_edges.size());
  for (const auto& [a, b] : sharp_edges) {
    boxes.push_back({a.cwiseMin(b), a.cwiseMax(b)});
  }
  if (boxes.empty()) return;
  tree_ = BoxTree(boxes, kLeafSize);
  segments_.reserve(boxes.size());
  for (const int item : tree_.order()) segments_.push_back(sharp_edges[item]);
}

double EdgeLengthField::operator()(const Eigen::Vector3d& x) const {
  if (least_ >= largest_) return largest_;
  // Farther away than this h is L anyway.
  const double reach = (largest_ - least_) / kSlope;
  double nearest = reach * reach;
  tree_.NearestFirst(
      nearest, [&](int node) { return tree_.nodes()[node].SquaredDistance(x); },
      [&](int position) {
        nearest = std::min(nearest, SquaredDistance(segments_[position], x));
        return nearest;
      });
  return std::min(largest_, least_ + kSlope * std::sqrt(nearest));
}

}  // namespace phongpd::internal
