// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/any_mesh.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "core/mesh/mesh_io.h"
#include "core/mesh/polygon_soup.h"
#include "problems/meshes/assimp_mesh.h"
#include "problems/meshes/files_beside.h"
#include "problems/meshes/robot_link.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;

std::string Lowered(std::string text) {
  for (char& c : text) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

// The extension in small letters, without a link's name.
std::string ExtensionOf(const std::string& path) {
  return Lowered(
      fs::path(path.substr(0, FilePartOf(path))).extension().string());
}

bool IsRobot(const std::string& extension) {
  return extension == ".urdf" || extension == ".sdf";
}

bool IsImported(const std::string& extension) {
  return extension == ".dae" || extension == ".gltf" || extension == ".glb" ||
         extension == ".3mf";
}

}  // namespace

const char* const kMeshFormats =
    "OFF, OBJ, STL, PLY; COLLADA, glTF, GLB, 3MF in single precision; a link "
    "of URDF or SDF as robot.urdf#link, all of a URDF as robot.urdf@joint=1.5";

std::size_t FilePartOf(const std::string& name) {
  const std::string lowered = Lowered(name);
  std::size_t end = 0;
  for (const std::string extension : {".urdf", ".sdf"}) {
    for (const char mark : {'#', '@'}) {
      const std::size_t at = lowered.rfind(extension + mark);
      if (at != std::string::npos) end = std::max(end, at + extension.size());
    }
  }
  return end > 0 ? end : name.size();
}

bool NamesMesh(const std::string& path) {
  const std::string extension = ExtensionOf(path);
  return extension == ".off" || extension == ".obj" || extension == ".stl" ||
         extension == ".ply" || IsImported(extension) || IsRobot(extension);
}

TriangleMesh ReadAnyMesh(const std::string& path,
                         std::vector<std::string>* warnings,
                         const std::string& root) {
  std::vector<std::string> unused;
  if (warnings == nullptr) warnings = &unused;
  const std::string extension = ExtensionOf(path);
  if (IsRobot(extension)) return ReadRobotLink(path, root, warnings);
  if (IsImported(extension)) {
    ImportedMesh imported = ReadByAssimp(path, root);
    warnings->push_back(path + ": " + imported.note);
    return std::move(imported.mesh);
  }
  if (root.empty()) return ReadMesh(path);
  return internal::ReadMeshBytes(
      ReadMeshFile(path, root, "a mesh file", kMaxMeshBytes), path);
}

OmplAppMesh ReadOmplAppMesh(const std::string& path,
                            std::vector<std::string>* warnings,
                            const std::string& root) {
  if (IsImported(ExtensionOf(path))) {
    ImportedMesh imported = ReadByAssimp(path, root, MeshFrame::kAssimp);
    if (warnings != nullptr) {
      warnings->push_back(path +
                          ": unit and up axis that the file names are applied, "
                          "as OMPL.app has them; read in single precision");
    }
    return {std::move(imported.mesh), imported.center};
  }
  OmplAppMesh read = {ReadAnyMesh(path, warnings, root), {0.0, 0.0, 0.0}};
  for (const Eigen::Vector3d& vertex : read.mesh.vertices) {
    read.center += vertex / static_cast<double>(read.mesh.vertices.size());
  }
  return read;
}

}  // namespace phongpd
