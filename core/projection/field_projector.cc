// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/field_projector.h"

#include <algorithm>
#include <utility>

#include "core/mesh/numbers.h"

namespace phongpd {

namespace {
// No interior point is deeper; the field frame has a diagonal in [1, 2).
constexpr double kDiagonal = 2.0;
using internal::kInfinity;
}  // namespace

using Eigen::Vector3d;

FieldProjector::FieldProjector(PhongField field, FieldKind kind)
    : field_(std::move(field)),
      kind_(kind),
      prisms_(BuildOffsetPrisms(field_)) {
  if (kind_ == FieldKind::kTangentPlane) {
    planes_ = BuildTangentPlaneField(field_);
  }
}

int FieldProjector::Project(int triangle, const Vector3d& x, double max_depth,
                            const Vector3d& start,
                            std::array<Projection, 3>* found) const noexcept {
  if (kind_ != FieldKind::kTangentPlane) {
    return Project(triangle, x, max_depth, 0.0, kInfinity, found);
  }
  TangentPlaneHit hit;
  if (!ProjectOnTangentPlanes(field_, planes_, triangle, x, start, &hit) ||
      !(hit.s <= kOnSurface && hit.s >= -max_depth)) {
    return 0;
  }
  const Vector3d positive = hit.lambda.cwiseMax(0.0);
  (*found)[0] = {triangle, positive / positive.sum(), std::min(hit.s, 0.0),
                 std::max(-hit.s, 0.0)};
  return 1;
}

int FieldProjector::Project(int triangle, const Vector3d& x, double max_depth,
                            double least, double most,
                            std::array<Projection, 3>* found) const noexcept {
  if (kind_ == FieldKind::kTangentPlane) {
    return Project(triangle, x, max_depth, found);
  }
  const OffsetPrism& prism = prisms_[triangle];
  // |n(λ)| ≤ 1, so |s| may exceed the depth, without bound only in a field
  // that could not be kept admissible.
  double s_min = -std::min(
      most, std::min(max_depth, kDiagonal) / std::max(prism.min_norm, 1e-3));
  double s_max = least > 0.0 ? -least : kOnSurface;
  if (s_min > s_max || !prism.Narrow(x, &s_min, &s_max)) return 0;
  std::array<NormalHit, 3> hits;
  const int hit_count = prism.Project(x, s_min, s_max, &hits);
  int count = 0;
  for (int i = 0; i < hit_count; ++i) {
    const double depth = -prism.SignedDepth(hits[i]);
    if (depth > max_depth) continue;
    (*found)[count++] = {triangle, hits[i].lambda, std::min(hits[i].s, 0.0),
                         std::max(depth, 0.0)};
  }
  return count;
}

Vector3d FieldProjector::UnitNormal(const Projection& p) const noexcept {
  if (kind_ == FieldKind::kTangentPlane) {
    return TangentPlaneNormal(field_, planes_, p.triangle, p.lambda);
  }
  const Vector3d n = prisms_[p.triangle].Normal(p.lambda);
  const double norm = n.norm();
  return norm > 0.0 ? Vector3d(n / norm) : Vector3d::Zero();
}

Vector3d FieldProjector::Gradient(const Projection& p) const noexcept {
  if (kind_ == FieldKind::kTangentPlane) {
    const Vector3d n = UnitNormal(p);
    const Vector3d x = Point(p) + p.s * n;
    TangentPlaneHit hit;
    const bool found =
        ProjectOnTangentPlanes(field_, planes_, p.triangle, x, p.lambda, &hit);
    return found && hit.gradient.squaredNorm() > 0.0 ? hit.gradient : n;
  }
  return prisms_[p.triangle].DepthGradient({p.lambda, p.s});
}

}  // namespace phongpd
