// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

// Mesh files as CGAL reads and writes them.
namespace phongpd::internal {

enum class MeshFormat { kOff, kObj, kStl, kPly };

// Points and polygons as a file holds them; indices are unchecked, and
// negative where the file's did not fit.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<int>> polygons;
};

// Reads `in`, which holds `size` bytes; throws InputError naming `path`.
// CGAL's readers do the work, behind checks for what those of CGAL 5.5.1 do
// not survive: OFF and PLY counts beyond the size of the file, OFF lines with
// and without colours mixed, PLY coordinates that are missing or no floating
// point numbers, OBJ statements other than vertices and faces.
PolygonSoup ReadSoup(MeshFormat format, std::istream& in, std::size_t size,
                     const std::string& path);

// Writes text with 17 significant digits; false when the stream failed.
// Requires finite points and valid indices.
bool WriteSoup(MeshFormat format, const PolygonSoup& soup, std::ostream& out);

}  // namespace phongpd::internal
