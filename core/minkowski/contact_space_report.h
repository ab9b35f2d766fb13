// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/bounds/approximation.h"
#include "core/bounds/mesh_repair.h"
#include "core/solid/mesh_check.h"

namespace phongpd {

// What touches what on a piece of contact surface.
enum class ContactKind {
  kObstacleFacet,  // facet of the obstacle on a vertex of the robot
  kRobotFacet,     // vertex of the obstacle on a facet of the robot
  kEdges,          // an edge of each
  kNone,           // nothing: a wall around what was modelled
};

// What the expensive stages were expected to cost, known after a few percent of
// the time.  A guide, fitted on two cores, and no bound: for coplanar operands
// it may predict four times too many faces.
struct PredictedCost {
  double meetings = 0.0;  // pairs of convolution facets that cut each other
  double arrangement_faces = 0.0;
  double seconds = 0.0;
  double mib = 0.0;
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
  // Pairs of output triangles of one component that meet after rounding to
  // double (the exact result has none, but a solid that touches itself
  // counts), and triangles whose rounded area is zero.
  std::size_t self_intersections = 0;
  std::size_t degenerate_triangles = 0;
  // Triangle quality (mesh/triangle_quality.h): 1 equilateral, 0 degenerate.
  double worst_quality = 0.0;
  double median_quality = 0.0;
  // Read from a cache (contact_space_cache.h): all else is of the first build.
  bool from_cache = false;
  // Wall seconds per stage, in order of execution.
  std::vector<std::pair<std::string, double>> seconds;
  double peak_mib = 0.0;  // of the process so far
  PredictedCost predicted;
  std::string method = "reduced convolution, exact arrangement";
  // Triangles of the reduced convolution, faces and cells of its arrangement,
  // and collision tests that classified the cells.
  std::size_t convolution_triangles = 0;
  std::size_t arrangement_faces = 0;
  std::size_t cells = 0;
  std::size_t judged_cells = 0;
  // The work was done in a turned frame in which more facets are axis-aligned.
  bool canonical_frame = false;
  // Input coordinates are placed on an integer grid first; nothing else is
  // approximated.  None was moved by more than this, user's unit; 0: they lie
  // on a lattice (grid_frame.h) and nothing was rounded.
  double grid_step = 0.0;
  // All that is not exact because the options said so.
  Approximation approximation;
  // The operands as they were found, after a repair if there was one.
  MeshReport robot;
  MeshReport obstacle;
  RepairReport robot_repair;
  RepairReport obstacle_repair;
  std::vector<std::string> warnings;
};

}  // namespace phongpd
