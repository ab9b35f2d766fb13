// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mesh/numbers.h"
#include "core/minkowski/arrangement/face_geometry.h"
#include "core/minkowski/arrangement/facet_intersections.h"
#include "core/minkowski/arrangement/plane_arrangement.h"
#include "core/minkowski/arrangement/plane_groups.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/cells/radial_edges.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/convolution/window_convolution.h"
#include "core/minkowski/operands/exact_points.h"
#include "core/minkowski/windows/grid_window.h"

namespace phongpd::internal {

// The convolution's facets in a window and the walls of it, arranged: which
// faces are in the window, which are of walls, and what is nearest on one.  The
// walls look into the window.  Half steps.  Stays where it is: its members
// refer to each other.
struct WindowArrangement {
  // The patches make up the walls.  Throws InputError when `limits` are passed.
  WindowArrangement(const WindowConvolution& sums, const GridWindow& window,
                    std::vector<WallPatch> the_patches,
                    const BuildLimits& limits);
  WindowArrangement(const WindowArrangement&) = delete;
  WindowArrangement& operator=(const WindowArrangement&) = delete;

  bool IsWall(int face) const {
    return arrangement.faces[face].facet >= first_wall;
  }
  // Per face: is it in the window, or of a wall?
  std::vector<char> FindInside() const;
  // Per half-edge: bit k where it lies in a wall across axis k.
  std::vector<int> WallsOfEdges() const;
  BoundingBox BoxOf(int face) const;
  // The patch that a face of a wall lies in; `around` is its box.
  int PatchOf(int face, const BoundingBox& around) const;

  struct FacePoint {
    double squared_distance = kInfinity;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // from q
  };
  // The point of a face nearest to q, found relative to q; none where the
  // face's plane is no nearer than the root of `limit`.
  FacePoint NearestOn(int face, const Eigen::Vector3d& q, double limit) const;
  // Of a point within 2^-12 of a grid step: does it lie in the face's plane?
  bool LiesInPlane(int face, const Eigen::Vector3d& q) const;
  // The convolution facet that the face is part of at a point of it: coplanar
  // facets are arranged together.
  int FacetAt(int face, const Eigen::Vector3d& point) const;

  int first_wall;  // facets from here on are of walls, two a patch
  BoundingBox box;
  std::vector<WallPatch> patches;
  Convolution convolution;
  PlaneGroups groups;
  ExactPoints points;
  Arrangement arrangement;
  RadialEdges radial;
  FaceGeometry geometry{convolution, arrangement, points};

 private:
  void CutAlongPatches(FacetIntersections* intersections);
  // Of a point in a facet's plane to the facet.
  double SquaredDistanceInPlane(int f, const Eigen::Vector3d& point) const;
};

}  // namespace phongpd::internal
