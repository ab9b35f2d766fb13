// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/inside_test.h"
#include "core/bvh/surface_tree.h"
#include "core/mesh/triangle_mesh.h"
#include "core/projection/penetration_metric.h"

namespace phongpd {

// Throws InputError unless the mesh is closed and edge-manifold, with
// triangles, valid indices, finite coordinates and a diagonal in [1e-150,
// 1e150].
void CheckContactMesh(const TriangleMesh& mesh);

// A contact space ready for Euclidean answers: the exact inside test in the
// user's coordinates and the closest-point tree.  EuclideanMetric answers with
// it everywhere; PhongMetric outside and where no projection exists, so that
// the two agree there bit for bit.
class ContactSurface {
 public:
  // Closed, outward, edge-manifold.  Throws InputError as CheckContactMesh.
  explicit ContactSurface(const TriangleMesh& mesh);

  // Can queries at q be answered?  q and q − centre must be finite.
  bool Accepts(const Eigen::Vector3d& q) const {
    return (q - tree_.center()).allFinite();
  }
  Location Locate(const Eigen::Vector3d& q) const { return inside_.Locate(q); }

  // What a distance is at least off the surface, where rounding says 0: far
  // below any rounding, so that 0 means touching and the sign is exact.
  double LeastDistance() const { return 0x1p-104 / tree_.scale(); }

  // Euclidean answer at an accepted q whose location is known.  The direction
  // is the facet's normal where q_c is inside a facet or q lies on it (to
  // 1e-12 of the diagonal), and (q_c − q)/|q_c − q| elsewhere.
  PenetrationResult Answer(const Eigen::Vector3d& q_o,
                           Location location) const noexcept;

  // Distance of an accepted q to the surface, ≥ 0, rounded.
  double Distance(const Eigen::Vector3d& q) const noexcept {
    return tree_.FindClosest(q).distance;
  }

  // Σ λ_i q_i on a triangle, exact to an ulp where a coordinate is constant.
  Eigen::Vector3d Point(int triangle, const Eigen::Vector3d& lambda) const;
  const TriangleMesh& mesh() const { return mesh_; }

 private:
  TriangleMesh mesh_;
  std::vector<Eigen::Vector3d> facet_normals_;  // zero if degenerate
  InsideTest inside_;
  SurfaceTree tree_;
};

}  // namespace phongpd
