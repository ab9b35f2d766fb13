// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// Labels the shells of a closed, edge-manifold mesh, the parts connected
// through edges: the units of one orientation.  Parts that only touch in a
// vertex are different shells.  Labels as in LabelComponents.
std::vector<int> LabelShells(const TriangleMesh& mesh, int* count);
// The same from what TriangleNeighbors returned.
std::vector<int> LabelShells(const std::vector<std::array<int, 3>>& neighbors,
                             int* count);

// Solid angle of a closed mesh seen from `p` by its turns, ±1 inside a shell,
// 0 outside, fractions on the surface (van Oosterom and Strackee 1983).
double Turns(const TriangleMesh& mesh, const Eigen::Vector3d& p);

// Turns shells so that the mesh bounds a volume outward, and returns how many
// it turned.  Shell j encloses shell i when they do not cross and i is inside
// j, whatever their directions.
//  - An outermost shell of negative volume is turned together with all it
//    encloses: a mirrored file gives the same solid, cavities included.
//  - Then, from the outside in, a shell of negative volume is turned unless
//    the shells that enclose it count as positive, Σ sign > 0: then it is a
//    cavity.
//
// Requires a closed, edge-manifold, consistently oriented mesh.  Throws
// InputError naming `name` when shells have no volume, |volume| ≤
// 1e-14 · area · diagonal, where the sign is rounding.
int TurnOutward(const std::string& name, TriangleMesh* mesh);

}  // namespace phongpd::internal
