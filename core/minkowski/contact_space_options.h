// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "core/bounds/mesh_repair.h"

namespace phongpd {

// What to build, how, and within which limits.
struct ContactSpaceOptions {
  // Join exactly coplanar triangles and re-triangulate (most slivers vanish).
  bool merge_coplanar = true;
  // Drop bounded free cavities: a translating robot cannot get there from
  // outside.  Kept and reported by default.
  bool outer_shell_only = false;
  // What happens to operands that are meshes and no solids.
  Repair repair = Repair::kReject;
  // Approximations, in the order in which they are applied
  // (mesh_approximation.h), each with a proved bound in the report; by default
  // there is none.  Alpha wrap of both operands, a fraction of the operand's
  // diagonal; 0: none.
  double wrap_alpha = 0.0;
  // The robot's convex hull in its place.
  bool robot_hull = false;
  // Decimate each operand to about this many triangles; 0: none.
  std::size_t target_faces = 0;
  // Limits of a build.  BuildRefusal is thrown at once if the prediction is
  // above a limit, and later if the build itself passes one.  Seconds; 0: no
  // limit. MiB by which the process grows; infinity: no limit; 0: nine tenths
  // of what is free when the build begins, without refusal by prediction.  If
  // all facets at once are predicted to need more memory, they are arranged by
  // boxes, which takes about the same time and gives the same bytes (the
  // report's `method` says so); not with merge_coplanar = false.
  double max_seconds = 0.0;
  double max_mib = 0.0;
  // What messages call operands that are meshes, e.g. the files they came
  // from; a Solid has its own name.
  std::string robot_name = "robot";
  std::string obstacle_name = "obstacle";
};

}  // namespace phongpd
