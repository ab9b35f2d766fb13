// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_io.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/mesh/polygon_soup.h"
#include "core/mesh/polygon_triangulation.h"

namespace phongpd {
namespace {

using internal::PolygonSoup;
using internal::SoupPoint;

enum class Format { kOff, kObj, kStl, kPly };

Format FormatOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (extension == ".off") return Format::kOff;
  if (extension == ".obj") return Format::kObj;
  if (extension == ".stl") return Format::kStl;
  if (extension == ".ply") return Format::kPly;
  throw InputError(path +
                   ": unknown mesh format; expected the extension .off, .obj, "
                   ".stl or .ply, found " +
                   (extension.empty() ? "none" : "\"" + extension + "\"") +
                   "; convert the file");
}

std::ifstream Open(const std::string& path, std::size_t* size) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw InputError(path + ": expected a mesh file, found a directory");
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    const bool exists = std::filesystem::exists(path, error);
    throw InputError(path + ": cannot be opened; expected a readable file, " +
                     (exists ? "found one that is not; check its permissions"
                             : "found nothing; check the path"));
  }
  in.seekg(0, std::ios::end);
  *size = static_cast<std::size_t>(std::max<std::streamoff>(in.tellg(), 0));
  in.clear();
  in.seekg(0);
  if (*size == 0) {
    throw InputError(path + ": expected a mesh, found an empty file");
  }
  return in;
}

PolygonSoup ReadSoup(const std::string& path) {
  const Format format = FormatOf(path);
  std::size_t size = 0;
  std::ifstream in = Open(path, &size);
  switch (format) {
    case Format::kOff:
      return internal::ReadOff(in, size, path);
    case Format::kObj:
      return internal::ReadObj(in, path);
    case Format::kStl:
      return internal::ReadStl(in, path);
    case Format::kPly:
      return internal::ReadPly(in, size, path);
  }
  throw std::logic_error("unhandled mesh format");
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

std::vector<Eigen::Vector3d> CheckedVertices(const PolygonSoup& soup,
                                             const std::string& path) {
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(soup.points.size());
  Complaint non_finite, bad_index;
  for (const SoupPoint& p : soup.points) {
    vertices.emplace_back(p.x(), p.y(), p.z());
    if (!vertices.back().allFinite()) non_finite.Add(vertices.size() - 1);
  }
  non_finite.ThrowIfAny(path, "finite coordinates",
                        "vertices with NaN or infinity");
  const int n = static_cast<int>(vertices.size());
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::vector<int>& polygon = soup.polygons[i];
    if (std::any_of(polygon.begin(), polygon.end(),
                    [n](int v) { return v < 0 || v >= n; })) {
      bad_index.Add(i);
    }
  }
  bad_index.ThrowIfAny(path, "indices of existing vertices",
                       "faces with an index out of range");
  return vertices;
}

}  // namespace

TriangleMesh ReadMesh(const std::string& path) {
  PolygonSoup soup;
  try {
    soup = ReadSoup(path);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    // CGAL and the standard library: a count that no memory can hold.
    throw InputError(path + ": unreadable; " + error.what());
  }
  TriangleMesh mesh;
  mesh.vertices = CheckedVertices(soup, path);
  std::vector<Eigen::Vector3d> corners;
  for (const std::vector<int>& polygon : soup.polygons) {
    corners.clear();
    for (const int v : polygon) corners.push_back(mesh.vertices[v]);
    for (const auto& [a, b, c] : internal::TriangulatePolygon(corners)) {
      mesh.triangles.push_back({polygon[a], polygon[b], polygon[c]});
    }
  }
  if (mesh.triangles.empty()) {
    throw InputError(path + ": expected faces, found " +
                     std::to_string(mesh.vertices.size()) +
                     " vertices and no face; export it as a surface mesh");
  }
  return mesh;
}

void WriteMesh(const TriangleMesh& mesh, const std::string& path) {
  const Format format = FormatOf(path);
  PolygonSoup soup;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    soup.points.emplace_back(v.x(), v.y(), v.z());
  }
  for (const Triangle& t : mesh.triangles) {
    soup.polygons.emplace_back(t.begin(), t.end());
  }
  CheckedVertices(soup, path);
  std::ofstream out(path, std::ios::binary);
  out.precision(17);
  bool is_written = out.good();
  switch (format) {
    case Format::kOff:
      is_written &= CGAL::IO::write_OFF(out, soup.points, soup.polygons);
      break;
    case Format::kObj:
      is_written &= CGAL::IO::write_OBJ(out, soup.points, soup.polygons);
      break;
    case Format::kStl:
      is_written &= CGAL::IO::write_STL(out, soup.points, soup.polygons);
      break;
    case Format::kPly:
      is_written &= CGAL::IO::write_PLY(out, soup.points, soup.polygons);
      break;
  }
  if (!is_written || !out.flush()) {
    throw InputError(path +
                     ": cannot be written; expected a writable path "
                     "with room for " +
                     std::to_string(mesh.triangles.size()) + " triangles");
  }
}

}  // namespace phongpd
