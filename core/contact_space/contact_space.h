// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/contact_space/approximation.h"
#include "core/mesh/mesh_check.h"
#include "core/mesh/mesh_repair.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// What touches what on a piece of contact surface.
enum class ContactKind {
  kObstacleFacet,  // facet of the obstacle on a vertex of the robot
  kRobotFacet,     // vertex of the obstacle on a facet of the robot
  kEdges,          // an edge of each
};

// Finer triangles inside the planar patches; the surface stays as it is
// (surface_refinement.h says how exactly).
//
// Not for PhongPD's sake: the paper's field (ℓ = 0) is tied to the
// tessellation.  Vertices inside a patch have the facet's normal, so the field
// turns within one triangle of an edge, and PhongPD nears Euclidean PD.  Cone
// and axes, 100 random motions, target_edge 0 / 0.1 / 0.02, grading 1: cold
// depth / Euclidean depth 1.19 / 1.03 / 1.01 on average, warm 1.5 / 1.5 / 1.6
// with a 99th percentile of 6.6 / 7.7 / 8.9; jumps 52 / 49 / 40.  With ℓ = 0.1
// none of these moves by more than noise: that field splits edges by itself.
struct RefineOptions {
  // Longest edge, as a fraction of the surface's diagonal; 0: no refinement.
  // In [0, 1].
  double target_edge = 0.0;
  // Longest edge at sharp edges, as a fraction of target_edge; it grows by half
  // the distance from them.  1: the same everywhere.  In (0, 1].
  double grading = 0.25;
  // Edges between facets whose normals differ by this are sharp.  In [0, 180].
  double sharp_angle_degrees = 20.0;

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

struct ContactSpaceOptions {
  // Join exactly coplanar triangles and re-triangulate (most slivers vanish).
  bool merge_coplanar = true;
  // Drop bounded free cavities: a translating robot cannot get there from
  // outside.  Kept and reported by default.
  bool outer_shell_only = false;
  // What happens to operands that are no solids.
  Repair repair = Repair::kReject;
  // Approximations, each with a proved bound in the report; all off, in the
  // order they are applied in (mesh_approximation.h).  Alpha wrap of both
  // operands, a fraction of the operand's diagonal; 0: none.
  double wrap_alpha = 0.0;
  // The robot's convex hull in its place.
  bool robot_hull = false;
  // Decimate each operand to about this many triangles; 0: none.
  std::size_t target_faces = 0;
  // Limits of a build.  Refused at once, with the predicted figure, where that
  // is above them, and stopped where the build itself passes them: InputError.
  // Seconds; 0: no limit.  MiB by which the process grows; 0: nine tenths of
  // what is free when the build begins, which only stops; infinity: no limit.
  double max_seconds = 0.0;
  double max_mib = 0.0;
  RefineOptions refine;
  // Names used in error messages, e.g. the files the operands came from.
  std::string robot_name = "robot";
  std::string obstacle_name = "obstacle";
};

// What the expensive stages were expected to cost, known after a few percent
// of the time: a guide fitted on two cores, not a bound.  Faces come out up to
// four times too many where the operands are coplanar.
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

// C_cont = ∂C_obj with C_obj = B ⊕ (−A), the boundary of all robot positions
// q for which A + q and B meet; closed, outward, bounded free cavities
// included as inward shells.  Topology is exact; coordinates are the exact
// vertices rounded to double.
struct ContactSpace {
  TriangleMesh mesh;
  // Supporting plane of each triangle: triangles with equal id lie exactly in
  // one oriented plane.
  std::vector<int> plane;
  std::vector<ContactKind> kind;  // of each triangle
  ContactSpaceReport report;
};

// Builds the contact space of a translating `robot` (A) and a fixed
// `obstacle` (B) by reduced convolution on an integer grid, exact arrangement
// per supporting plane, and one collision judgement per candidate cell
// (design and references: core/README.md).  Operands may have any genus and
// several, even overlapping, components.
//
// Both operands go through RepairSolid first: inside-out components are turned
// and said in the report, anything unusable throws InputError; with the
// default options nothing else is changed.  Throws
// std::logic_error if the arrangement leaks (the unbounded cell turns out
// occupied), which no valid input should cause.
ContactSpace BuildContactSpace(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const ContactSpaceOptions& options = {});

}  // namespace phongpd
