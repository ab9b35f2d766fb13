// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/solid/mesh_defects.h"

namespace phongpd {

// The triangles at the defects, each once, as a coloured OFF or PLY file by the
// extension of `path`: red at open edges, orange at edges of three or more,
// blue at edges of two directions, magenta at self-intersections (the first of
// these that a triangle has).  A mesh to look at beside the other; without
// defects it has neither vertices nor faces.  Throws InputError for another
// extension.
std::string DefectMeshContent(const TriangleMesh& mesh,
                              const std::vector<MeshDefect>& defects,
                              const std::string& path);

}  // namespace phongpd
