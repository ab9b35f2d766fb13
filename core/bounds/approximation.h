// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace phongpd {

// One deviation from the exact contact space that was asked for.
struct ApproximationStep {
  std::string operand;  // its name; empty: the contact space itself
  std::string kind;     // "robot-hull", "decimation", "alpha-wrap",
                        // "outer-shell"
  // lower_bound ≤ Hausdorff distance of the solids before and after ≤ bound,
  // proved (mesh_approximation.h), user's unit.
  double bound = 0.0;
  double lower_bound = 0.0;
  // The input was no solid: the bound is that of the wrap's surface.
  bool is_surface_bound = false;
  // The solid only grew: what the result calls free is free.
  bool is_conservative = true;
  std::size_t triangles_before = 0;
  std::size_t triangles_after = 0;
  int dropped_cavities = 0;  // of "outer-shell"
};

// How far a contact space is from the exact one.  The Hausdorff distance of
// B ⊕ (−A) to the exact solid is at most `bound`, the sum over the steps of
// both operands.  It bounds the SOLID: a slot, cavity or wall narrower than
// about twice the bound may vanish or appear.  "outer-shell" counts nothing:
// outside of the dropped cavities the result is what it was.  The grid
// (ContactSpaceReport::grid_step) comes on top.
struct Approximation {
  std::string kind = "none";  // of the steps, joined by "+"
  double bound = 0.0;
  bool is_conservative = true;
  std::vector<ApproximationStep> steps;
};

}  // namespace phongpd
