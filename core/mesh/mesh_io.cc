// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mesh/counted.h"
#include "core/mesh/finite.h"
#include "core/mesh/input_file.h"
#include "core/mesh/polygon_soup.h"
#include "core/mesh/polygon_triangulation.h"

namespace phongpd {
namespace {

using internal::MeshFormat;
using internal::PolygonSoup;

MeshFormat FormatOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (extension == ".off") return MeshFormat::kOff;
  if (extension == ".obj") return MeshFormat::kObj;
  if (extension == ".stl") return MeshFormat::kStl;
  if (extension == ".ply") return MeshFormat::kPly;
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    throw InputError(path +
                     ": expected a mesh file, found a directory; name a file "
                     "in it");
  }
  throw InputError(path +
                   ": unknown mesh format; expected the extension .off, .obj, "
                   ".stl or .ply, found " +
                   (extension.empty() ? "none" : "\"" + extension + "\"") +
                   "; convert the file");
}

// "what" with the count and the first of them, or nothing if there is none.
class Complaint {
 public:
  void Add(std::size_t index) {
    if (count_++ == 0) first_ = index;
  }
  void ThrowIfAny(const std::string& path, const char* expected,
                  const char* what) const {
    if (count_ == 0) return;
    throw InputError(path + ": expected " + expected + ", found " +
                     std::to_string(count_) + " " + what + ", the first is " +
                     std::to_string(first_) + " (from 0); export it again");
  }

 private:
  std::size_t count_ = 0;
  std::size_t first_ = 0;
};

void RequireValid(const PolygonSoup& soup, const std::string& path) {
  Complaint non_finite, bad_index;
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    if (!IsFinite(soup.points[i])) non_finite.Add(i);
  }
  non_finite.ThrowIfAny(path, "finite coordinates",
                        "vertices with NaN or infinity");
  const int n = static_cast<int>(soup.points.size());
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::vector<int>& polygon = soup.polygons[i];
    if (std::any_of(polygon.begin(), polygon.end(),
                    [n](int v) { return v < 0 || v >= n; })) {
      bad_index.Add(i);
    }
  }
  bad_index.ThrowIfAny(path, "indices of existing vertices",
                       "faces with an index out of range");
}

}  // namespace

TriangleMesh ReadMesh(const std::string& path) {
  FormatOf(path);  // refused before it is read
  return internal::ReadMeshBytes(
      ReadInputFile(path, "a mesh file", kMaxMeshBytes), path);
}

TriangleMesh internal::ReadMeshBytes(std::string_view bytes,
                                     const std::string& file) {
  const MeshFormat format = FormatOf(file);
  if (bytes.empty()) {
    throw InputError(file + ": expected a mesh, found an empty file");
  }
  return ReadMeshBytes(format, bytes, file);
}

TriangleMesh internal::ReadMeshBytes(MeshFormat format, std::string_view bytes,
                                     const std::string& file) {
  PolygonSoup soup = ReadSoup(format, bytes, file);
  RequireValid(soup, file);
  TriangleMesh mesh;
  mesh.vertices = std::move(soup.points);
  std::vector<Eigen::Vector3d> corners;
  for (const std::vector<int>& polygon : soup.polygons) {
    corners.clear();
    for (const int v : polygon) corners.push_back(mesh.vertices[v]);
    for (const auto& [a, b, c] : TriangulatePolygon(corners)) {
      mesh.triangles.push_back({polygon[a], polygon[b], polygon[c]});
    }
  }
  if (mesh.triangles.empty()) {
    throw InputError(file + ": expected faces, found " +
                     Counted(mesh.vertices.size(), "vertex", "vertices") +
                     " and no face; export it as a surface mesh");
  }
  return mesh;
}

std::string MeshContent(const TriangleMesh& mesh, const std::string& path) {
  const MeshFormat format = FormatOf(path);
  PolygonSoup soup;
  soup.points = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    soup.polygons.emplace_back(t.begin(), t.end());
  }
  RequireValid(soup, path);
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // it would swallow std::bad_alloc
  internal::WriteSoup(format, soup, out);
  return out.str();
}

void WriteMesh(const TriangleMesh& mesh, const std::string& path) {
  const std::string content = MeshContent(mesh, path);
  std::ofstream out(path, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!out.flush()) {
    throw InputError(path +
                     ": cannot be written; expected a writable path "
                     "with room for " +
                     Counted(mesh.triangles.size(), "triangle"));
  }
}

}  // namespace phongpd
