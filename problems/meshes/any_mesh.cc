// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/any_mesh.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "core/mesh/mesh_io.h"
#include "problems/meshes/assimp_mesh.h"
#include "problems/meshes/robot_link.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;

// The extension in small letters, without a link's name.
std::string ExtensionOf(const std::string& path) {
  const std::size_t hash = path.rfind('#');
  std::string extension = fs::path(path).extension().string();
  if (hash != std::string::npos) {
    // A file may have such a name, a link's has an extension before it.
    const std::string before = fs::path(path.substr(0, hash)).extension();
    if (before.size() == 4 || before.size() == 5) extension = before;
  }
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension;
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
    "of URDF or SDF as robot.urdf#link";

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
  RequireBelow(path, root);
  if (IsImported(extension)) {
    ImportedMesh imported = ReadByAssimp(path);
    warnings->push_back(path + ": " + imported.note);
    return std::move(imported.mesh);
  }
  return ReadMesh(path);
}

void RequireBelow(const std::string& path, const std::string& root) {
  if (root.empty()) return;
  std::error_code error;
  const fs::path folder = fs::canonical(root, error);
  if (error || !fs::is_directory(folder, error)) {
    throw InputError(root +
                     ": expected the root folder of mesh files, found "
                     "none");
  }
  const fs::path resolved = fs::weakly_canonical(path, error);
  const bool is_below =
      !error && std::mismatch(folder.begin(), folder.end(), resolved.begin(),
                              resolved.end())
                        .first == folder.end();
  if (is_below) return;
  throw InputError(path + ": expected a file below the root " + root +
                   ", found one elsewhere; move it there");
}

}  // namespace phongpd
