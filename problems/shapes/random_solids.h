// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <random>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Random solids and points for tests and benchmarks.  Random engines are
// passed in; same state, same result.
namespace phongpd {

// An axis-aligned box [min, max] with corners on the lattice of quarters:
// coordinates are in quarters of a unit.
struct LatticeBox {
  std::array<int, 3> min;
  std::array<int, 3> max;
};

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

// The cells as boxes of the lattice.
std::vector<LatticeBox> LatticeBoxes(const Voxels& voxels);

// Every box as a component of its own: they may overlap, and touch in faces,
// edges and vertices.
TriangleMesh BoxesMesh(const std::vector<LatticeBox>& boxes);

// Volume of { b − a } over all points of two unions of boxes: the contact
// space's by counting cells, in the unit cubed.
double LatticeSumVolume(const std::vector<LatticeBox>& robot,
                        const std::vector<LatticeBox>& obstacle);

// VoxelSurface of RandomVoxels without edge contact: the worst case of
// coplanarity.
TriangleMesh RandomVoxelSolid(int n, double fill, std::mt19937_64* random);

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
