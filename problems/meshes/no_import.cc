// SPDX-License-Identifier: GPL-3.0-or-later
// In the place of assimp_mesh.cc and robot_*.cc, where their packages are
// missing.
#include "core/mesh/mesh_error.h"
#include "problems/meshes/assimp_mesh.h"
#include "problems/meshes/robot_link.h"

namespace phongpd {
namespace {

[[noreturn]] void Refuse(const std::string& path) {
  throw InputError(path +
                   ": expected a mesh in OFF, OBJ, STL or PLY, found another; "
                   "this build, like wheels, is without Assimp and tinyxml2; "
                   "export it as STL, or build from source with libassimp-dev "
                   "and libtinyxml2-dev");
}

}  // namespace

ImportedMesh ReadByAssimp(const std::string& path, const std::string& /*root*/,
                          MeshFrame /*frame*/) {
  Refuse(path);
}

TriangleMesh ReadRobotLink(const std::string& path, const std::string&,
                           std::vector<std::string>*) {
  Refuse(path);
}

}  // namespace phongpd
