// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/gauss_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Far above the rounding of unit vectors.
constexpr double kRoom = 1e-9;
// cos 85°: beyond 90° a cap no longer holds the sums of what it holds.
constexpr double kLeastCosine = 0.087;

}  // namespace

GaussCap CapAround(const Vector3d* normals, std::size_t count) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += normals[i];
  GaussCap cap;
  const double length = sum.norm();
  if (!(length > 1e-3)) return cap;
  const Vector3d center = sum / length;
  double squared = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (normals[i].dot(center) < kLeastCosine) return cap;
    squared = std::max(squared, (normals[i] - center).squaredNorm());
  }
  cap.center = center;
  cap.radius = std::sqrt(squared) + kRoom;
  return cap;
}

GaussTree::GaussTree(std::vector<GaussCap> caps) : caps_(std::move(caps)) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(caps_.size());
  for (const GaussCap& cap : caps_) {
    boxes.push_back(
        {cap.center.array() - cap.radius, cap.center.array() + cap.radius});
  }
  tree_ = BoxTree(boxes, 4);
}

}  // namespace phongpd::internal
