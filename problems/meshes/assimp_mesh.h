// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

struct ImportedMesh {
  TriangleMesh mesh;
  // What to know of it, for people.
  std::string note;
  // Metres to a unit of length of the mesh; 0: the file does not say.
  double metres = 0.0;
};

// The triangles of a COLLADA, glTF, GLB or 3MF file below `root`, if that is
// not empty; see ReadAnyMesh.
ImportedMesh ReadByAssimp(const std::string& path, const std::string& root);

}  // namespace phongpd
