// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/followed_metric.h"

#include <algorithm>
#include <cmath>

#include "core/projection/vertex_normals.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// What the frame of distances can tell from the surface, in it.
constexpr double kOnSurface = 1e-13;

}  // namespace

FollowedMetric::FollowedMetric(const ContactSpace& space)
    : surface_(space),
      walk_(space),
      vertex_normals_(VertexNormals(space.mesh(), space.normals())) {}

Vector3d FollowedMetric::SheetNormal(const MeshPoint& point) const {
  const std::vector<Vector3d>& normals = surface_.space().normals();
  int zeros = 0, zero = 0, corner = 0;
  for (int k = 0; k < 3; ++k) {
    if (point.lambda[k] > 0.0) {
      corner = k;
    } else {
      ++zeros;
      zero = k;
    }
  }
  if (zeros == 2) {
    return vertex_normals_[surface_.mesh().triangles[point.triangle][corner]];
  }
  Vector3d normal = normals[point.triangle];
  if (zeros == 1) {
    normal += normals[walk_.neighbors(point.triangle)[(zero + 1) % 3]];
  }
  return normal;
}

PenetrationResult FollowedMetric::Cold(const Vector3d& q,
                                       QueryStatus status) const {
  PenetrationResult result = surface_.Answer(q, Location::kInside);
  result.status = status;
  const SurfaceFoot foot =
      walk_.FootOn(result.triangle, surface_.bvh().ToFrame(q));
  result.branch = {foot.point.triangle, foot.point.lambda,
                   result.signed_distance};
  return result;
}

PenetrationResult FollowedMetric::AnswerAt(const SurfaceFoot& foot,
                                           const Vector3d& q) const {
  PenetrationResult result;
  result.status = QueryStatus::kOk;
  result.inside = true;
  result.triangle = foot.point.triangle;
  result.contact = surface_.Point(foot.point.triangle, foot.point.lambda);
  const double depth =
      std::sqrt(foot.squared_distance) / surface_.bvh().scale();
  result.signed_distance = -std::max(depth, surface_.LeastDistance());
  const bool is_in_facet = foot.point.lambda.minCoeff() > 0.0;
  const bool is_at_contact = foot.squared_distance <= kOnSurface * kOnSurface;
  const Vector3d away = result.contact - q;
  result.direction = is_in_facet || is_at_contact
                         ? SheetNormal(foot.point).normalized()
                         : away.normalized();
  result.gradient = result.direction;
  result.branch = {foot.point.triangle, foot.point.lambda,
                   result.signed_distance};
  return result;
}

PenetrationResult FollowedMetric::Query(const Vector3d& q,
                                        const Branch& previous) const {
  if (!surface_.Accepts(q)) return {};
  const Location location = surface_.Locate(q);
  const bool is_inside = location == Location::kInside;
  const bool is_known = previous.triangle >= 0 &&
                        previous.triangle < static_cast<int>(walk_.size());
  if (!is_known) {
    return is_inside ? Cold(q, QueryStatus::kOk) : surface_.Answer(q, location);
  }
  SurfaceWay way;
  const Vector3d x = surface_.bvh().ToFrame(q);
  const SurfaceFoot foot =
      walk_.Descend({previous.triangle, previous.lambda}, x, &way);
  const double beyond = SheetNormal(foot.point).dot(x - walk_.At(foot.point));
  if (!is_inside) {
    PenetrationResult result = surface_.Answer(q, location);
    // Still behind the sheet: the branch's depth does not go through 0.
    if (beyond < -kOnSurface) result.status = QueryStatus::kBranchEnded;
    return result;
  }
  if (beyond > kOnSurface) return Cold(q, QueryStatus::kBranchEnded);
  return AnswerAt(foot, q);
}

}  // namespace phongpd
