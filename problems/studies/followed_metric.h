// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/projection/contact_surface.h"
#include "core/projection/penetration_metric.h"
#include "core/projection/surface_walk.h"

namespace phongpd {

// MakeFollowedMetric (study_metrics.h).  Its branches name a point of the
// contact mesh, with s = −depth; one with a triangle that is not there counts
// as none.
class FollowedMetric final : public PenetrationMetric {
 public:
  explicit FollowedMetric(const ContactSpace& space);

  using PenetrationMetric::Query;
  PenetrationResult Query(const Eigen::Vector3d& q,
                          const Branch& previous) const override;

 private:
  PenetrationResult Cold(const Eigen::Vector3d& q, QueryStatus status) const;
  // Outward, of the sheet around a point: the facet's normal, the sum of two at
  // an edge, weighted by angle at a vertex.  Its sign against q − x tells the
  // side of q wherever x is locally closest (Baerentzen and Aanaes 2005).
  Eigen::Vector3d SheetNormal(const MeshPoint& point) const;
  PenetrationResult AnswerAt(const SurfaceFoot& foot,
                             const Eigen::Vector3d& q) const;

  ContactSurface surface_;
  SurfaceWalk walk_;
  std::vector<Eigen::Vector3d> vertex_normals_;
};

}  // namespace phongpd
