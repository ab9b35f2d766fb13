// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/minkowski/arrangement/plane_groups.h"
#include "core/minkowski/cells/cells.h"

namespace phongpd::internal {

// The boundary of the free cells: planar patches bounded by loops.  Order and
// numbers follow from the surface alone, not from how it was found
// (surface_order.h).
struct PatchSurface {
  std::vector<int> vertex_points;  // ExactPoints id of each vertex
  // Of its point: number among the surface's, and nearest doubles, grid steps.
  std::vector<int> vertex_ranks;
  std::vector<Eigen::Vector3d> positions;
  struct Patch {
    int facet = 0;                        // convolution facet of its plane
    std::vector<std::vector<int>> loops;  // vertices, patch on the left
  };
  std::vector<Patch> patches;
};

class BuildLimits;

struct AssemblyOptions {
  bool merge_coplanar = true;
  bool outer_only = false;              // leave out the shells of cavities
  int units_per_step = 1;               // of the points' coordinates
  const BuildLimits* limits = nullptr;  // of the build; null: none
};

// Takes the free sides whose opposite side is occupied.  Around an edge with
// more than two of them they are paired across the *occupied* sectors, so
// solids that only touch stay separate and every vertex gets one fan: the
// result is manifold, with coincident vertices where solids touch.
//
// With merge_coplanar, faces of one plane that are joined by an edge form one
// patch, and a border vertex between the same two planes on both sides is
// dropped: both its edges lie on the planes' common line.  This removes most
// slivers and leaves the surface the same point set, however its faces had been
// cut.
//
// Where one solid touches itself along an edge both sheets would still share
// the two ends of that edge, or an edge of one would be a diagonal of another's
// patch: such edges get a mid-point of their own (added to `points`).
PatchSurface AssembleSurface(const Arrangement& arrangement,
                             const PlaneGroups& groups,
                             const RadialEdges& radial, const FreeCells& cells,
                             const AssemblyOptions& options,
                             ExactPoints* points);

}  // namespace phongpd::internal
