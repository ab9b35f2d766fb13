// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// CGAL's alpha wrap (Portaneri et al. 2022): closed, outward, strictly around
// the triangles of `mesh`, whatever they are.  Tunnels and pockets narrower
// than about 2 · alpha are closed; cavities are always filled.  Lengths in the
// mesh's unit.
TriangleMesh WrapTriangles(const TriangleMesh& mesh, double alpha,
                           double offset);

}  // namespace phongpd::internal
