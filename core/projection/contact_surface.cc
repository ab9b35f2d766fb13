// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/contact_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/mesh/finite.h"
#include "core/mesh/unit_normal.h"

namespace phongpd {

using Eigen::Vector3d;

namespace {

// ContactSurface::LeastDistance, in the frame of distances.
constexpr double kLeast = 0x1p-104;

}  // namespace

ContactSurface::ContactSurface(ContactSpace space)
    : space_(std::move(space)),
      bvh_(&space_.bvh()),
      normals_(&space_.normals()) {}

Vector3d PointOn(const TriangleMesh& mesh, int triangle,
                 const Vector3d& lambda) {
  const Triangle& t = mesh.triangles[triangle];
  const Vector3d& q0 = mesh.vertices[t[0]];
  if (lambda[1] == 1.0) return mesh.vertices[t[1]];
  if (lambda[2] == 1.0) return mesh.vertices[t[2]];
  return q0 + lambda[1] * (mesh.vertices[t[1]] - q0) +
         lambda[2] * (mesh.vertices[t[2]] - q0);
}

PenetrationResult EuclideanAnswer(const NearestContact& nearest,
                                  const Vector3d& q_o, Location location,
                                  double scale) noexcept {
  PenetrationResult result;
  result.status = QueryStatus::kOk;
  result.inside = location == Location::kInside;
  result.triangle = nearest.triangle;
  result.contact = nearest.point;
  // At the end of doubles a distance may overflow; no result is infinite.
  const double distance = location == Location::kOnSurface
                              ? 0.0
                              : std::clamp(nearest.distance, kLeast / scale,
                                           std::numeric_limits<double>::max());
  result.signed_distance = result.inside ? -distance : distance;
  const Vector3d& normal = nearest.normal;
  const bool at_contact = distance * scale <= 1e-12;
  Vector3d direction = result.inside ? Vector3d(result.contact - q_o)
                                     : Vector3d(q_o - result.contact);
  // The norm may be beyond all doubles where no coordinate is.
  if (direction.cwiseAbs().maxCoeff() > 1e300) direction *= 0x1p-10;
  direction = Unit(direction);
  if ((nearest.is_in_facet || at_contact) && normal.squaredNorm() > 0.0) {
    // A foot inside the facet, but not the facet's side q_o is on: rounding
    // in a sliver; the difference is the better answer there.
    if (at_contact || normal.dot(direction) > 0.9) direction = normal;
  }
  result.direction = direction;
  result.gradient = direction;
  return result;
}

double ContactSurface::LeastDistance() const { return kLeast / bvh_->scale(); }

PenetrationResult ContactSurface::Answer(const Vector3d& q_o,
                                         Location location) const noexcept {
  const TriangleBvh::Closest closest = bvh_->FindClosest(q_o);
  NearestContact nearest;
  nearest.point = Point(closest.triangle, closest.lambda);
  nearest.distance = closest.distance;
  nearest.normal = (*normals_)[closest.triangle];
  nearest.is_in_facet = closest.lambda.minCoeff() > 0.0;
  nearest.triangle = closest.triangle;
  return EuclideanAnswer(nearest, q_o, location, bvh_->scale());
}

}  // namespace phongpd
