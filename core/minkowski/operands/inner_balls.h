// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/minkowski/operands/grid_solid.h"

namespace phongpd::internal {

// A ball that lies in a solid, grid steps; a point for radius 0.
struct InnerBall {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

// The grid solid as a mesh that can be searched; coordinates stay exact.
TriangleBvh BvhOf(const GridSolid& solid);

// At most `most` large balls inside `solid`, which `bvh` is of, the largest
// first: each touches the surface from within at one of some points evenly
// spread over it, and at a second point ("shrinking ball": Ma, Bae, Choi, 3D
// medial axis point approximation using nearest neighbors, 2012).  Balls that
// add little to a larger one are left out.
//
// What is inside is told by winding numbers; where components overlap, balls
// end at either surface.
std::vector<InnerBall> InnerBalls(const GridSolid& solid,
                                  const TriangleBvh& bvh, std::size_t most);

}  // namespace phongpd::internal
