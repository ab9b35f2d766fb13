// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Mesh files as points and polygons.
//
// The readers are our own, because CGAL's (5.5.1) cannot be made safe from
// outside: its PLY reader allocates what a list claims to hold, its OFF scanner
// casts any double of a face line to an index, and OBJ had to be parsed before
// it to leave out what it refuses.  These check every count against the bytes
// that are left before they allocate or repeat anything: memory stays below
// 100 times the file.
namespace phongpd::internal {

enum class MeshFormat { kOff, kObj, kStl, kPly };

// Points and polygons as a file holds them; indices are unchecked, and
// negative where the file's did not fit.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<int>> polygons;
};

// Reads a file of at most kMaxMeshBytes (mesh_io.h); throws InputError naming
// `file`.
PolygonSoup ReadSoup(MeshFormat format, std::string_view bytes,
                     const std::string& file);
// One format each.
PolygonSoup ReadOff(std::string_view bytes, const std::string& file);
PolygonSoup ReadObj(std::string_view bytes, const std::string& file);
PolygonSoup ReadStl(std::string_view bytes, const std::string& file);
PolygonSoup ReadPly(std::string_view bytes, const std::string& file);

// ReadMesh of a file that has been read: checks and triangulates its soup.
TriangleMesh ReadMeshBytes(MeshFormat format, std::string_view bytes,
                           const std::string& file);
// The same in the format that the file's name says.
TriangleMesh ReadMeshBytes(std::string_view bytes, const std::string& file);

// Writes text with 17 significant digits, through CGAL; false when the stream
// failed.  Requires finite points and valid indices.
bool WriteSoup(MeshFormat format, const PolygonSoup& soup, std::ostream& out);

}  // namespace phongpd::internal
