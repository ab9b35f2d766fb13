// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

struct ContactSpaceOptions {
  // Join exactly coplanar triangles and re-triangulate (most slivers vanish).
  bool merge_coplanar = true;
  // Drop bounded free cavities: a translating robot cannot get there from
  // outside.  Kept and reported by default.
  bool outer_shell_only = false;
  // Names used in error messages, e.g. the files the operands came from.
  std::string robot_name = "robot";
  std::string obstacle_name = "obstacle";
};

// What was built, how, and at what cost.
struct ContactSpaceReport {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  bool closed = false;    // every half-edge has its opposite
  bool manifold = false;  // and every vertex one fan
  int components = 0;     // connected pieces of the surface
  int genus = 0;          // summed over components
  int cavities = 0;       // bounded free cells
  double volume = 0.0;    // of C_obj, user's unit cubed
  // Pairs of output triangles that meet after rounding to double (the exact
  // result has none).
  std::size_t self_intersections = 0;
  // Wall seconds per stage, in order of execution.
  std::vector<std::pair<std::string, double>> seconds;
  double peak_mib = 0.0;  // of the process so far
  std::string method = "reduced convolution, exact arrangement";
  // Triangles of the reduced convolution and of its arrangement.
  std::size_t convolution_triangles = 0;
  std::size_t arrangement_triangles = 0;
  std::size_t cells = 0;
  // Input coordinates are rounded to a binary grid first; nothing else is
  // approximated.  Largest displacement, user's unit.
  double grid_step = 0.0;
  std::vector<std::string> warnings;
};

// C_cont = ∂C_obj with C_obj = B ⊕ (−A), the boundary of all robot positions
// q for which A + q and B meet; closed, outward, bounded free cavities
// included as inward shells.  Topology is exact; coordinates are the exact
// vertices rounded to double.
struct ContactSpace {
  TriangleMesh mesh;
  // Supporting plane of each triangle: triangles with equal id lie exactly in
  // one oriented plane.
  std::vector<int> plane;
  ContactSpaceReport report;
};

// Builds the contact space of a translating `robot` (A) and a fixed
// `obstacle` (B) by reduced convolution on an integer grid, exact arrangement
// per supporting plane, and one collision judgement per candidate cell
// (design and references: core/README.md).  Operands may have any genus and
// several, even overlapping, components.
//
// Preconditions: both meshes as MakeSolid returns them.  Throws InputError
// for operands MakeSolid refuses, and std::logic_error if the result leaks
// (the outermost cell turns out occupied), which no valid input should cause.
ContactSpace BuildContactSpace(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const ContactSpaceOptions& options = {});

}  // namespace phongpd
