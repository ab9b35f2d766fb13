// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/contact_space_options.h"
#include "core/minkowski/contact_space_report.h"
#include "core/minkowski/grid_pair.h"

// What is done to the operands before the contact space is built, and said
// about it.
namespace phongpd::internal {

enum class OperandRole { kRobot, kObstacle };

// The solid to build with: repaired, wrapped, replaced by its hull (robot
// only) and decimated as the options ask for, in this order.  Fills in the
// operand's MeshReport and RepairReport, the approximation's steps and the
// warnings.  Throws InputError naming the operand.
TriangleMesh PrepareOperand(const TriangleMesh& mesh, OperandRole role,
                            const ContactSpaceOptions& options,
                            ContactSpaceReport* report);

// Appends a step and updates kind, bound and conservativeness.
void AddStep(const ApproximationStep& step, Approximation* approximation);

// Prepared operands on their common grid.  Adds a warning for each for which
// rounding by 2^-38 of the larger one is coarse: facets that collapsed, fewer
// than 24 bits.  Throws InputError naming the operand of which no solid is left
// on the grid.
GridPair PlaceOperands(const TriangleMesh& robot, const TriangleMesh& obstacle,
                       const ContactSpaceOptions& options,
                       ContactSpaceReport* report);

// For a contact space that leaks: throws InputError naming the
// operands that lost facets, by which they are no solids any more; returns
// where none did.
void RefuseLostFacets(const GridSolid& obstacle, const TriangleMesh& b,
                      const GridSolid& robot, const TriangleMesh& a,
                      double step, const ContactSpaceOptions& options);

}  // namespace phongpd::internal
