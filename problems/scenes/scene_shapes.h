// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// Builds the solid that a `shape` object of a scene file describes, e.g.
// {"type": "ball", "radius": 0.1, "triangles": 320}.  Parameters bear the
// names of problems/shapes/shapes.h and are all required; lengths in the
// scene's unit.  Types: ball (icosphere of 20·4^k triangles), uv_ball, box
// (size [x, y, z], centred), box_shell, cells, cone, axes, wrench, torus, l, u,
// plate_hole, plate_round_hole, prism, vessel, star, knot, tube (along `path`,
// a list of points), triangles (of one's own: vertices, and three numbers of
// them each, from 0 on), and scan (another shape `of`, finely tessellated and
// with noise).
//
// Throws InputError starting with `where` (file and JSON pointer) for an
// unknown type, a missing, unknown or ill-typed parameter, or a size that no
// solid has.
TriangleMesh MakeShape(const nlohmann::ordered_json& shape,
                       const std::string& where);

}  // namespace phongpd
