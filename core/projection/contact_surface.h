// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"
#include "core/mesh/finite.h"
#include "core/mesh/triangle_mesh.h"
#include "core/projection/penetration_metric.h"

namespace phongpd {

// The point of a surface that is nearest to some q_o.
struct NearestContact {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // outward; zero: unknown
  bool is_in_facet = false;                          // not on an edge or vertex
  int triangle = -1;
};

// Σ λ_i q_i on a triangle, exact to an ulp where a coordinate is constant.
Eigen::Vector3d PointOn(const TriangleMesh& mesh, int triangle,
                        const Eigen::Vector3d& lambda);

// The Euclidean answer that it makes, at a q_o whose location is known, in a
// frame of that scale (TriangleBvh::scale): ContactSurface::Answer.
PenetrationResult EuclideanAnswer(const NearestContact& nearest,
                                  const Eigen::Vector3d& q_o, Location location,
                                  double scale) noexcept;

// Euclidean answers over a contact space.  EuclideanMetric answers with it
// everywhere; PhongMetric outside and where no projection exists, so that the
// two agree there bit for bit.
class ContactSurface {
 public:
  explicit ContactSurface(ContactSpace space);

  // Can queries at q be answered?  q and q − centre must be finite.
  bool Accepts(const Eigen::Vector3d& q) const {
    return IsFinite(q - bvh_->center());
  }
  Location Locate(const Eigen::Vector3d& q) const { return bvh_->Locate(q); }

  // What a distance is at least off the surface, where rounding says 0: far
  // below any rounding, so that 0 means touching and the sign is exact.
  double LeastDistance() const;

  // Euclidean answer at an accepted q whose location is known.  The direction
  // is the facet's normal where q_c is inside a facet or q lies on it (to
  // 1e-12 of the diagonal), and (q_c − q)/|q_c − q| elsewhere.
  PenetrationResult Answer(const Eigen::Vector3d& q_o,
                           Location location) const noexcept;

  // Distance of an accepted q to the surface, ≥ 0, rounded.
  double Distance(const Eigen::Vector3d& q) const noexcept {
    return bvh_->FindClosest(q).distance;
  }

  // PointOn the mesh.
  Eigen::Vector3d Point(int triangle, const Eigen::Vector3d& lambda) const {
    return PointOn(mesh(), triangle, lambda);
  }
  const TriangleMesh& mesh() const { return space_.mesh(); }
  const ContactSpace& space() const { return space_; }
  const TriangleBvh& bvh() const { return *bvh_; }

 private:
  ContactSpace space_;
  // Of the space, which keeps them.
  const TriangleBvh* bvh_;
  const std::vector<Eigen::Vector3d>* normals_;
};

}  // namespace phongpd
