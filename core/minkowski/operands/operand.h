// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/minkowski/contact_space_options.h"
#include "core/minkowski/contact_space_report.h"
#include "core/minkowski/operands/grid_pair.h"
#include "core/solid/solid.h"

// What is done to the operands before the contact space is built, and said
// about it.
namespace phongpd::internal {

enum class OperandRole { kRobot, kObstacle };

// The solid to build with: replaced by its hull (robot only) and decimated or
// wrapped as the options ask for.  Fills in the operand's MeshReport, the
// approximation's steps and the warnings; those of the solid's own report were
// said when it was made.
Solid PrepareOperand(const Solid& solid, OperandRole role,
                     const ContactSpaceOptions& options,
                     ContactSpaceReport* report);

// The same of a mesh that is to be checked and repaired first, as the options
// ask for; its name is theirs.  Throws InputError naming it.
Solid PrepareOperand(const TriangleMesh& mesh, OperandRole role,
                     const ContactSpaceOptions& options,
                     ContactSpaceReport* report);

// The options with the names of the solids.
ContactSpaceOptions WithNames(ContactSpaceOptions options, const Solid& robot,
                              const Solid& obstacle);

// Appends a step and updates kind, bound and conservativeness.
void AddStep(const ApproximationStep& step, Approximation* approximation);

// Prepared operands on their common grid.  Adds a warning for each for which
// rounding by 2^-38 of the larger one is coarse: facets that collapsed, fewer
// than 24 bits.  Throws InputError naming the operand of which no solid is left
// on the grid.
GridPair PlaceOperands(const Solid& robot, const Solid& obstacle,
                       LatticeDivisor divisor, ContactSpaceReport* report);

// For a contact space that leaks: throws InputError naming the
// operands that lost facets, by which they are no solids any more; returns
// where none did.
void RefuseLostFacets(const GridSolid& obstacle, const Solid& b,
                      const GridSolid& robot, const Solid& a, double step);

}  // namespace phongpd::internal
