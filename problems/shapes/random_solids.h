// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Random solids and points for tests and benchmarks.  Random engines are
// passed in; same state, same result.
namespace phongpd {

// A set of unit cells of an n × n × n block, x fastest.
struct Voxels {
  int n = 0;
  std::vector<char> filled;
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();  // of the block, integers
};

enum class EdgeContact { kAllowed, kAvoided };

// Each cell filled with the given probability, the first always; the block in
// random integer position.  With kAvoided no two cells meet in an edge only,
// so that the surface is edge-manifold.
Voxels RandomVoxels(int n, double fill, EdgeContact contact,
                    std::mt19937_64* random);

// The surface of the cells as one mesh; needs kAvoided.  It may have several
// components, tunnels and cavities.
TriangleMesh VoxelSurface(const Voxels& voxels);

// Uniform in the box, widened by a tenth on every side.
Eigen::Vector3d RandomPoint(const BoundingBox& box, std::mt19937_64* random);

// A uniform rotation.
Eigen::Matrix3d RandomRotation(std::mt19937_64* random);

// Uniform on a random triangle (not area-weighted: small ones count too).
struct SurfacePoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  // of the facet, unit
};
SurfacePoint RandomSurfacePoint(const TriangleMesh& mesh,
                                std::mt19937_64* random);

}  // namespace phongpd
