// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace phongpd {

// In the order in which they are told.
enum class ApproximationKind {
  kAlphaWrap,   // of an operand
  kRobotHull,   // the robot is its convex hull
  kDecimation,  // of an operand
  kOuterShell   // cavities of the contact space are left out
};

// "alpha-wrap", "robot-hull", "decimation", "outer-shell"; never null.
const char* ApproximationName(ApproximationKind kind);
// The kind of that name, if there is one.
std::optional<ApproximationKind> FindApproximation(const std::string& name);

// One deviation from the exact contact space that was asked for.
struct ApproximationStep {
  std::string operand;  // its name; empty: the contact space itself
  ApproximationKind kind = ApproximationKind::kAlphaWrap;
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
  int dropped_cavities = 0;  // of kOuterShell
};

// How far a contact space is from the exact one.  The Hausdorff distance of
// B ⊕ (−A) to the exact solid is at most `bound`, the sum over the steps of
// both operands.  It bounds the SOLID: a slot, cavity or wall narrower than
// about twice the bound may vanish or appear.  kOuterShell counts nothing:
// outside of the dropped cavities the result is what it was.  The grid
// (ContactSpaceReport::grid_step) comes on top.
struct Approximation {
  double bound = 0.0;
  bool is_conservative = true;
  std::vector<ApproximationStep> steps;
};

// The names of the steps' kinds, each once, joined by "+"; "none".
std::string KindsOf(const Approximation& approximation);

}  // namespace phongpd
