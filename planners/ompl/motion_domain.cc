// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/motion_domain.h"

#include "core/mesh/finite.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Around everything, of its diagonal: any way through the outside can be bent
// into it.
constexpr double kRoom = 0.1;

BoundingBox Hull(const BoundingBox& a, const BoundingBox& b) {
  if (a.IsEmpty()) return b;
  return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
}

}  // namespace

MotionDomain DomainOf(const std::shared_ptr<const ContactModel>& model) {
  if (!model) return {};
  return {{model, &model->free_space()}, model->region()};
}

BoundingBox SamplingRegion(const FreeSpace& convolutions, const Vector3d& start,
                           const Vector3d& goal) {
  if (!convolutions.bounds().IsEmpty()) return convolutions.bounds();
  BoundingBox region = FreeSpace::NoBounds();
  for (const ConvolutionModel& model : convolutions.convolutions()) {
    region = Hull(region, model.bounds());
  }
  for (const Vector3d& q : {start, goal}) {
    if (IsFinite(q)) region = Hull(region, {q, q});
  }
  const Vector3d room = Vector3d::Constant(kRoom * region.Diagonal());
  return {region.min - room, region.max + room};
}

}  // namespace phongpd
