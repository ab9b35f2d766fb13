// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/polygon_soup.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <istream>
#include <ostream>
#include <sstream>
#include <utility>

#include "core/mesh/mesh_error.h"

namespace phongpd::internal {
namespace {

// Plain doubles: a filtered kernel would compare points exactly while it
// joins them, and NaN in an exact predicate kills the process.
using Point = CGAL::Simple_cartesian<double>::Point_3;

struct CgalSoup {
  std::vector<Point> points;
  std::vector<std::vector<int>> polygons;
};

[[noreturn]] void Refuse(const std::string& path, const std::string& what) {
  throw InputError(path + ": " + what);
}

[[noreturn]] void RefuseContent(const std::string& path, const char* format) {
  Refuse(path, std::string("unreadable; expected a complete ") + format +
                   " file, found other or truncated content; export it again");
}

// A vertex or a face takes at least four bytes in every format.
void RequirePlausible(std::size_t count, const char* element, std::size_t size,
                      const std::string& path) {
  if (count <= size / 4) return;
  Refuse(path, "header declares " + std::to_string(count) + " " + element +
                   "; expected no more than a file of " + std::to_string(size) +
                   " bytes can hold; the file is truncated or damaged");
}

// Reads the header, which the caller rewinds, and checks in it what CGAL takes
// for granted.
void CheckPlyHeader(std::istream& in, std::size_t size,
                    const std::string& path) {
  std::string line, element;
  std::size_t coordinates = 0;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string keyword, type, name;
    words >> keyword >> type >> name;
    if (keyword == "end_header") break;
    if (keyword == "element") {
      element = type;
      std::size_t count = 0;
      if (!(std::istringstream(name) >> count)) RefuseContent(path, "PLY");
      RequirePlausible(count, element.c_str(), size, path);
    } else if (keyword == "property" && element == "vertex" &&
               (name == "x" || name == "y" || name == "z")) {
      const bool is_real = type == "float" || type == "float32" ||
                           type == "double" || type == "float64";
      if (!is_real) {
        Refuse(path, "vertex property " + name +
                         "; expected float or double, found " + type +
                         "; export it again with floating point coordinates");
      }
      ++coordinates;
    }
  }
  if (coordinates != 3) {
    Refuse(path, "PLY header; expected vertex properties x, y and z, found " +
                     std::to_string(coordinates) + " of them; export it again");
  }
}

// The number of corners each face line of an OBJ file has, and the file with
// nothing but vertex lines and "f i j k ..." lines.
struct ObjGeometry {
  std::vector<std::size_t> corners;
  std::string text;
};

ObjGeometry KeepObjGeometry(std::istream& in, const std::string& path) {
  ObjGeometry geometry;
  std::string line, next;
  while (std::getline(in, line)) {
    const auto drop_line_end = [](std::string* s) {
      while (!s->empty() && s->back() == '\r') s->pop_back();
    };
    drop_line_end(&line);
    while (!line.empty() && line.back() == '\\' && std::getline(in, next)) {
      drop_line_end(&next);
      line.back() = ' ';
      line += next;
    }
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      geometry.text += line + "\n";
    } else if (word == "f") {
      std::size_t corners = 0;
      geometry.text += "f";
      for (; words >> word && word.front() != '#'; ++corners) {
        const std::string index = word.substr(0, word.find('/'));
        if (index.find_first_not_of("+-0123456789") != std::string::npos) {
          Refuse(path, "face " + std::to_string(geometry.corners.size() + 1) +
                           "; expected vertex indices, found \"" + word + "\"");
        }
        geometry.text += " " + index;
      }
      geometry.text += "\n";
      geometry.corners.push_back(corners);
    }
  }
  return geometry;
}

CgalSoup ReadOff(std::istream& in, std::size_t size, const std::string& path) {
  // CGAL's scanner, but not its read_OFF: that one allocates what the header
  // says and reads colours that a line may not have.
  CGAL::File_scanner_OFF scanner(in, false);
  if (!in) RefuseContent(path, "OFF");
  if (scanner.n_dimensional()) {
    Refuse(path, "nOFF header; expected points in three dimensions");
  }
  RequirePlausible(scanner.size_of_vertices(), "vertices", size, path);
  RequirePlausible(scanner.size_of_facets(), "faces", size, path);
  CgalSoup soup;
  soup.points.reserve(scanner.size_of_vertices());
  for (std::size_t i = 0; i < scanner.size_of_vertices(); ++i) {
    double x = 0, y = 0, z = 0;
    scanner.scan_vertex(x, y, z);
    if (!in) RefuseContent(path, "OFF");
    soup.points.emplace_back(x, y, z);
    scanner.skip_to_next_vertex(i);
  }
  soup.polygons.resize(scanner.size_of_facets());
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    std::size_t corners = 0;
    scanner.scan_facet(corners, i);
    for (std::size_t j = 0; j < corners && in; ++j) {
      std::size_t index = 0;
      scanner.scan_facet_vertex_index(index, j + 1, i);
      soup.polygons[i].push_back(static_cast<int>(index));
    }
    if (!in) {
      Refuse(path, "face " + std::to_string(i + 1) + " of " +
                       std::to_string(soup.polygons.size()) +
                       "; expected its number of corners and as many indices "
                       "below " +
                       std::to_string(soup.points.size()) +
                       ", found another or no line; export it again");
    }
    scanner.skip_to_next_facet(i);
  }
  return soup;
}

CgalSoup ReadPly(std::istream& in, std::size_t size, const std::string& path) {
  CheckPlyHeader(in, size, path);
  in.clear();
  in.seekg(0);
  CgalSoup soup;
  if (!CGAL::IO::read_PLY(in, soup.points, soup.polygons,
                          CGAL::parameters::verbose(false))) {
    RefuseContent(path, "PLY");
  }
  return soup;
}

CgalSoup ReadStl(std::istream& in, const std::string& path) {
  CgalSoup soup;
  if (!CGAL::IO::read_STL(in, soup.points, soup.polygons,
                          CGAL::parameters::verbose(false))) {
    RefuseContent(path, "STL");
  }
  return soup;
}

// Keeps vertices and faces and leaves out every other statement of OBJ, some
// of which CGAL refuses (lines, merging groups).  Joins continued lines.
CgalSoup ReadObj(std::istream& in, const std::string& path) {
  const ObjGeometry geometry = KeepObjGeometry(in, path);
  CgalSoup soup;
  std::istringstream text(geometry.text);
  // False also for a file without faces or with bad indices, which ReadMesh
  // tells apart.
  CGAL::IO::read_OBJ(text, soup.points, soup.polygons,
                     CGAL::parameters::verbose(false));
  if (soup.polygons.size() != geometry.corners.size()) {
    RefuseContent(path, "OBJ");
  }
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    if (soup.polygons[i].size() == geometry.corners[i]) continue;
    Refuse(path, "face " + std::to_string(i + 1) + "; expected " +
                     std::to_string(geometry.corners[i]) +
                     " vertex indices, found one that is no 32-bit integer");
  }
  return soup;
}

CgalSoup ReadCgalSoup(MeshFormat format, std::istream& in, std::size_t size,
                      const std::string& path) {
  switch (format) {
    case MeshFormat::kOff:
      return ReadOff(in, size, path);
    case MeshFormat::kObj:
      return ReadObj(in, path);
    case MeshFormat::kStl:
      return ReadStl(in, path);
    default:
      return ReadPly(in, size, path);
  }
}

}  // namespace

PolygonSoup ReadSoup(MeshFormat format, std::istream& in, std::size_t size,
                     const std::string& path) {
  CgalSoup read = ReadCgalSoup(format, in, size, path);
  PolygonSoup soup;
  soup.points.reserve(read.points.size());
  for (const Point& p : read.points) {
    soup.points.emplace_back(p.x(), p.y(), p.z());
  }
  soup.polygons = std::move(read.polygons);
  return soup;
}

bool WriteSoup(MeshFormat format, const PolygonSoup& soup, std::ostream& out) {
  std::vector<Point> points;
  points.reserve(soup.points.size());
  for (const Eigen::Vector3d& p : soup.points) {
    points.emplace_back(p.x(), p.y(), p.z());
  }
  out.precision(17);
  switch (format) {
    case MeshFormat::kOff:
      return CGAL::IO::write_OFF(out, points, soup.polygons);
    case MeshFormat::kObj:
      return CGAL::IO::write_OBJ(out, points, soup.polygons);
    case MeshFormat::kStl:
      return CGAL::IO::write_STL(out, points, soup.polygons);
    default:
      return CGAL::IO::write_PLY(out, points, soup.polygons);
  }
}

}  // namespace phongpd::internal
