// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/contact_space.h"

namespace phongpd {

// Nearby features of a surface that lie in different directions: the walls of
// a channel, the two sides of a concave edge.
//
// A feature is the point p of one triangle that is closest to q; its direction
// is u = (q − p)/|q − p|, the gradient of the distance |q − p|, or the facet's
// normal where |q − p| ≤ 1e-12 diagonals.
class FeatureSearch {
 public:
  struct Feature {
    int triangle = -1;
    double distance = 0.0;  // user's unit
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  };

  // Queries are thread-safe.
  explicit FeatureSearch(ContactSpace space);

  // The nearest feature with u·taken[i] < cos_limit for all i < count, exact
  // as the scan of all triangles is; false if there is none within `reach`
  // (user's unit, ≥ 0 or infinite), and for q not finite.  cos_limit in (0, 1).
  // Does not allocate.
  bool FindNext(const Eigen::Vector3d& q, const Eigen::Vector3d* taken,
                int count, double cos_limit, double reach,
                Feature* feature) const noexcept;

 private:
  // No point of a node's box, seen from x, leaves the cone about a taken
  // direction.
  bool IsShadowed(int index, const Eigen::Vector3d& x,
                  const Eigen::Vector3d* taken, int count,
                  double cos_limit) const noexcept;
  // Direction of a triangle's closest point; false for a degenerate triangle
  // that x lies on.
  bool Direction(const TriangleCorners& corners, const Eigen::Vector3d& lambda,
                 const Eigen::Vector3d& x,
                 Eigen::Vector3d* direction) const noexcept;

  ContactSpace space_;
  const TriangleBvh* bvh_;      // the space's
  std::vector<double> radius_;  // of each node's box, frame of distances
};

}  // namespace phongpd
