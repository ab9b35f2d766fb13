// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// In whose frame a mesh is: lengths and axes of the file, or those that Assimp
// makes of the unit and the up axis that it names.
enum class MeshFrame { kFile, kAssimp };

struct ImportedMesh {
  TriangleMesh mesh;
  // The mean of the vertices as Assimp splits them by normals; of kAssimp
  // alone.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  // What to know of it, for people.
  std::string note;
  // Metres to a unit of length of the mesh; 0: the file does not say.
  double metres = 0.0;
};

// The triangles of a COLLADA, glTF, GLB or 3MF file below `root`, if that is
// not empty; see ReadAnyMesh.
ImportedMesh ReadByAssimp(const std::string& path, const std::string& root,
                          MeshFrame frame = MeshFrame::kFile);

}  // namespace phongpd
