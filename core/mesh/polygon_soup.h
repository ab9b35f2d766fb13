// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Simple_cartesian.h>

#include <istream>
#include <string>
#include <vector>

// How ReadMesh gets at the content of a file; included by .cc files only.
namespace phongpd::internal {

// Plain doubles: a filtered kernel would compare points exactly while it
// joins them, and NaN in an exact predicate kills the process.
using SoupPoint = CGAL::Simple_cartesian<double>::Point_3;

// Points and polygons as a file holds them; indices are unchecked and
// negative where the file's did not fit.
struct PolygonSoup {
  std::vector<SoupPoint> points;
  std::vector<std::vector<int>> polygons;
};

// Each reads `in`, which holds `size` bytes, and throws InputError naming
// `path`.  They call CGAL's readers and keep away from them what those do not
// survive (CGAL 5.5.1): OFF and PLY counts beyond the size of the file, OFF
// lines with and without colours mixed, PLY coordinates that are no floating
// point numbers or missing.
PolygonSoup ReadOff(std::istream& in, std::size_t size,
                    const std::string& path);
PolygonSoup ReadPly(std::istream& in, std::size_t size,
                    const std::string& path);
PolygonSoup ReadStl(std::istream& in, const std::string& path);
// Keeps vertices and faces and leaves out every other statement of OBJ, some
// of which CGAL refuses (lines, merging groups).  Joins continued lines.
PolygonSoup ReadObj(std::istream& in, const std::string& path);

}  // namespace phongpd::internal
