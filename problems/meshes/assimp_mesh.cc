// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/meshes/assimp_mesh.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/contact/byte_stream.h"
#include "core/mesh/counted.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_io.h"
#include "core/mesh/polygon_triangulation.h"
#include "problems/meshes/files_beside.h"
#include "problems/meshes/sandbox.h"
#include "problems/output/text.h"
#include "problems/scenes/json_schema.h"

namespace phongpd {
namespace {

namespace fs = std::filesystem;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 29;  // of a file
constexpr std::size_t kMaxTriangles = 50'000'000;
constexpr int kMaxNodeDepth = 1000;  // of nodes in nodes

[[noreturn]] void Refuse(const std::string& file, const std::string& found) {
  throw InputError(file + ": expected a mesh, found " + found);
}

std::string Extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension;
}

Matrix4d MatrixOf(const aiMatrix4x4& m) {
  Matrix4d matrix;
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned k = 0; k < 4; ++k) {
      matrix(static_cast<int>(i), static_cast<int>(k)) = m[i][k];
    }
  }
  return matrix;
}

// All triangles of a scene; vertices of equal coordinates are one, for what
// Assimp splits by normals and textures was none.
class Collector {
 public:
  Collector(const aiScene& scene, const std::string& file)
      : scene_(scene), file_(file) {}

  void Take(const aiNode& node, const Matrix4d& place, int depth = 0) {
    if (depth > kMaxNodeDepth) {
      Refuse(file_, "more than " + std::to_string(kMaxNodeDepth) +
                        " nodes within each other");
    }
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) {
        Refuse(file_, "a node with a mesh that there is none of");
      }
      Take(*scene_.mMeshes[node.mMeshes[i]], place);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      const aiNode& child = *node.mChildren[i];
      Take(child, place * MatrixOf(child.mTransformation), depth + 1);
    }
  }

  TriangleMesh Finish() {
    if (mesh_.triangles.empty()) {
      Refuse(file_, "no face; export it as a surface mesh");
    }
    return std::move(mesh_);
  }

 private:
  void Take(const aiMesh& part, const Matrix4d& place) {
    if (part.mNumFaces > 0 && !part.HasPositions()) {
      Refuse(file_, "faces without vertices");
    }
    std::vector<Vector3d> corners;
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices < 3) continue;  // points and lines
      corners.clear();
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        corners.push_back(Corner(part, face.mIndices[k], place));
      }
      std::vector<int> ids;
      for (const Vector3d& corner : corners) ids.push_back(IdOf(corner));
      for (const auto& [a, b, c] : internal::TriangulatePolygon(corners)) {
        mesh_.triangles.push_back({ids[a], ids[b], ids[c]});
      }
      if (mesh_.triangles.size() > kMaxTriangles) {
        Refuse(file_, "more than " + std::to_string(kMaxTriangles) +
                          " triangles; make it smaller");
      }
    }
  }

  Vector3d Corner(const aiMesh& part, unsigned index, const Matrix4d& place) {
    if (index >= part.mNumVertices) {
      Refuse(file_, "a face with an index out of range");
    }
    const aiVector3D& v = part.mVertices[index];
    const Vector3d local(v.x, v.y, v.z);
    const Vector3d corner =
        place.topLeftCorner<3, 3>() * local + place.topRightCorner<3, 1>();
    if (!IsFinite(corner)) {
      Refuse(file_, "vertices with NaN or infinity; export it again");
    }
    return corner;
  }

  int IdOf(const Vector3d& v) {
    const std::array<double, 3> key = {v[0], v[1], v[2]};
    const int next = static_cast<int>(mesh_.vertices.size());
    const auto [at, is_new] = ids_.emplace(key, next);
    if (is_new) mesh_.vertices.push_back(v);
    return at->second;
  }

  const aiScene& scene_;
  const std::string& file_;
  std::map<std::array<double, 3>, int> ids_;
  TriangleMesh mesh_;
};

// What Assimp may open: the file, from memory, and others in its folder or
// below.
class OwnFiles : public Assimp::IOSystem {
 public:
  // What it is told the file is called.
  static std::string Name(const std::string& path) {
    return kFolder + fs::path(path).filename().string();
  }

  OwnFiles(const std::string& path, const std::string& bytes,
           const FilesBeside& folder)
      : path_(path), name_(Name(path)), bytes_(bytes), folder_(folder) {}

  bool Exists(const char* name) const override { return name == name_; }
  char getOsSeparator() const override { return '/'; }
  void Close(Assimp::IOStream* file) override { delete file; }

  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (name == name_) return Stream(bytes_, false);
    if (mode[0] != 'r') return nullptr;
    std::string rest = name;
    if (rest.rfind(kFolder, 0) == 0) rest.erase(0, kFolder.size());
    try {
      return Stream(folder_.Read(rest, path_ + ": '" + rest.substr(0, 80) + "'",
                                 "a file beside or below it", kMaxBytes),
                    true);
    } catch (const InputError& error) {
      refusal_ = error.what();
      return nullptr;
    }
  }

  // Of a file that was asked for; empty: none was refused.
  const std::string& refusal() const { return refusal_; }

 private:
  static Assimp::IOStream* Stream(const std::string& bytes, bool owns) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (owns) {
      auto* const copy = new std::uint8_t[bytes.size()];
      std::copy(data, data + bytes.size(), copy);
      data = copy;
    }
    return new Assimp::MemoryIOStream(data, bytes.size(), owns);
  }

  inline static const std::string kFolder = "./";
  const std::string& path_;
  const std::string name_;
  const std::string& bytes_;
  const FilesBeside& folder_;
  std::string refusal_;
};

// "COLLADA, unit 0.0254 m, Z_UP".
std::string ColladaFrame(const std::string& bytes, const std::string& file,
                         double* metres) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) {
    Refuse(file, std::string("no XML (") + document.ErrorStr() + ")");
  }
  const tinyxml2::XMLElement* const root = document.RootElement();
  const tinyxml2::XMLElement* const asset =
      root == nullptr ? nullptr : root->FirstChildElement("asset");
  const tinyxml2::XMLElement* const unit =
      asset == nullptr ? nullptr : asset->FirstChildElement("unit");
  const tinyxml2::XMLElement* const up =
      asset == nullptr ? nullptr : asset->FirstChildElement("up_axis");
  // Both are COLLADA's defaults.
  *metres = unit == nullptr ? 1.0 : unit->DoubleAttribute("meter", 1.0);
  if (!(*metres > 0.0) || !std::isfinite(*metres)) {
    Refuse(file, "a unit of " + FormatDouble(*metres) + " m");
  }
  const char* const axis = up == nullptr ? nullptr : up->GetText();
  return "COLLADA, unit " + FormatDouble(*metres) + " m, " +
         (axis == nullptr ? "Y_UP" : axis);
}

// The JSON of a glTF file, or of a GLB one: its first chunk.
Json GltfDocument(const std::string& bytes, bool is_binary,
                  const std::string& file) {
  constexpr std::size_t kHeader = 20;  // of the file and the chunk
  std::string text = bytes;
  if (is_binary) {
    if (bytes.size() < kHeader) Refuse(file, "a file that is cut short");
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    text = bytes.substr(kHeader, length);
  }
  // A key twice would mean one thing here and another to Assimp.
  Json json = ParseJson(text, file);
  if (!json.is_object()) Refuse(file, "no JSON object");
  return json;
}

// Assimp leaves out triangles with indices out of range, without a word.
void RequireAllTriangles(const Json& json, const aiScene& scene,
                         const std::string& file) {
  const auto none = Json::array();
  std::uint64_t expected = 0, found = 0;
  const auto count = [&](const Json& accessor) -> std::uint64_t {
    return json.at("accessors").at(accessor.get<std::size_t>()).at("count");
  };
  try {
    for (const auto& mesh : json.value("meshes", none)) {
      for (const auto& part : mesh.at("primitives")) {
        const int mode = part.value("mode", 4);
        if (mode < 4) continue;  // points and lines
        const std::uint64_t corners = count(
            part.contains("indices") ? part.at("indices")
                                     : part.at("attributes").at("POSITION"));
        const std::uint64_t strip = corners < 3 ? 0 : corners - 2;
        expected += mode == 4 ? corners / 3 : strip;
      }
    }
  } catch (const Json::exception& error) {
    Refuse(file, std::string("other JSON than glTF's (") + error.what() + ")");
  }
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[i];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      found += part.mFaces[f].mNumIndices >= 3 ? 1 : 0;
    }
  }
  if (found >= expected) return;
  throw InputError(file + ": expected " + Counted(expected, "triangle") +
                   ", found " + std::to_string(found) +
                   ": the others have indices out of range; export it again");
}

// Adds the node's vertices, and those below, to the sum; returns how many.  In
// single precision and in this order, as OMPL.app does: of many vertices the
// rounding shows.
std::size_t AddVertices(const aiScene& scene, const aiNode& node,
                        aiMatrix4x4 place, int depth, aiVector3D* sum) {
  if (depth > kMaxNodeDepth) return 0;
  place *= node.mTransformation;
  std::size_t count = 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    for (unsigned k = 0; k < part.mNumVertices; ++k) {
      *sum += place * part.mVertices[k];
    }
    count += part.mNumVertices;
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    count += AddVertices(scene, *node.mChildren[i], place, depth + 1, sum);
  }
  return count;
}

Vector3d MeanOf(const aiScene& scene) {
  aiVector3D sum(0.0F, 0.0F, 0.0F);
  const std::size_t count =
      AddVertices(scene, *scene.mRootNode, aiMatrix4x4(), 0, &sum);
  sum /= static_cast<float>(std::max<std::size_t>(1, count));
  return {sum.x, sum.y, sum.z};
}

std::string Import(const std::string& path, const std::string& bytes,
                   const FilesBeside& folder, MeshFrame frame) {
  const std::string extension = Extension(path);
  double metres = 0.0;
  std::string note;
  bool keeps_root = true;
  Json gltf;
  if (extension == ".dae") {
    note = ColladaFrame(bytes, path, &metres) +
           ": lengths and axes are the file's own, nothing is scaled or turned";
    // Assimp turns and scales the scene there.
    keeps_root = frame == MeshFrame::kAssimp;
  } else if (extension == ".3mf") {
    note = "3MF: lengths are the file's own, millimetres unless it says other";
  } else {
    gltf = GltfDocument(bytes, extension == ".glb", path);
    note = "glTF: metres, Y up";
    metres = 1.0;
  }
  Assimp::Importer importer;
  auto* const files = new OwnFiles(path, bytes, folder);
  importer.SetIOHandler(files);  // which owns it
  const aiScene* const scene = importer.ReadFile(OwnFiles::Name(path), 0);
  // Also where it went on without.
  if (!files->refusal().empty()) throw InputError(files->refusal());
  if (scene == nullptr || scene->mRootNode == nullptr) {
    Refuse(path, std::string("what Assimp cannot read: ") +
                     importer.GetErrorString());
  }
  if (gltf.is_object()) RequireAllTriangles(gltf, *scene, path);
  Collector collector(*scene, path);
  collector.Take(*scene->mRootNode,
                 keeps_root ? MatrixOf(scene->mRootNode->mTransformation)
                            : Matrix4d(Matrix4d::Identity()));
  const TriangleMesh mesh = collector.Finish();
  note += "; read in single precision, about 7 digits of every coordinate";
  Vector3d center = Vector3d::Zero();
  if (frame == MeshFrame::kAssimp) {
    // As OMPL.app reads its meshes.
    const aiScene* const split = importer.ApplyPostProcessing(
        aiProcess_GenNormals | aiProcess_Triangulate |
        aiProcess_JoinIdenticalVertices | aiProcess_SortByPType |
        aiProcess_OptimizeGraph);
    if (split == nullptr || split->mRootNode == nullptr) {
      Refuse(path, "what Assimp cannot split by normals");
    }
    center = MeanOf(*split);
  }
  internal::ByteWriter writer;
  writer(note, metres, center, mesh.vertices, mesh.triangles);
  return writer.Take();
}

}  // namespace

ImportedMesh ReadByAssimp(const std::string& path, const std::string& root,
                          MeshFrame frame) {
  const std::string bytes = ReadMeshFile(path, root, "a mesh file", kMaxBytes);
  if (bytes.empty()) Refuse(path, "an empty file");
  const FilesBeside folder(path, root);
  const std::string answer = RunInSandbox(
      path, [&] { return Import(path, bytes, folder, frame); },
      LimitsFor(bytes.size()));
  ImportedMesh imported;
  internal::ByteReader reader(answer);
  reader(imported.note, imported.metres, imported.center,
         imported.mesh.vertices, imported.mesh.triangles);
  if (!reader.Done()) Refuse(path, "one that its reader did not finish");
  return imported;
}

}  // namespace phongpd
