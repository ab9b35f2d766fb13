// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::bench {

// CGAL's AABB tree with its accelerator of distances (a k-d tree of vertices),
// over doubles, its fastest kernel: closest points without the question of
// inside or outside.
class CgalClosestPoint {
 public:
  explicit CgalClosestPoint(const TriangleMesh& mesh);
  ~CgalClosestPoint();
  CgalClosestPoint(const CgalClosestPoint&) = delete;
  CgalClosestPoint& operator=(const CgalClosestPoint&) = delete;

  double Distance(const Eigen::Vector3d& q) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd::bench
