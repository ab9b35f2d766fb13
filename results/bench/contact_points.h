// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd::bench {

// Where two solids that touch do so: of all places at which a vertex of one
// lies on the other, or two edges cross, the mean.  For what touches in one
// place that is the witness point of depth.h, found by other code.
class ContactPoints {
 public:
  explicit ContactPoints(const TriangleMesh& obstacle);

  // Of a robot in place; `within` is what rounding may leave between them,
  // user's unit.  False, and *mean as it was, where they do not touch.
  bool Mean(const TriangleMesh& robot, double within,
            Eigen::Vector3d* mean) const;

 private:
  TriangleMesh obstacle_;
  TriangleBvh bvh_;
  std::vector<std::array<Eigen::Vector3d, 2>> edges_;
};

}  // namespace phongpd::bench
