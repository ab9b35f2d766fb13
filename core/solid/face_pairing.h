// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Which faces share an edge, for meshes that need not be manifold.  Faces that
// use a vertex twice have no edges.
namespace phongpd::internal {

using Faces = std::vector<Triangle>;

// Edges that do not have two faces.
std::size_t CountUnpairedEdges(const Faces& faces);

// Turns faces like the majority of those they are connected to through edges
// of two faces, and returns how many.  A surface of one side stays as it is.
std::size_t OrientAlike(Faces* faces);

}  // namespace phongpd::internal
