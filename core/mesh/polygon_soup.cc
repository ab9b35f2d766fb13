// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/polygon_soup.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <ostream>

namespace phongpd::internal {

PolygonSoup ReadSoup(MeshFormat format, std::string_view bytes,
                     const std::string& file) {
  switch (format) {
    case MeshFormat::kOff:
      return ReadOff(bytes, file);
    case MeshFormat::kObj:
      return ReadObj(bytes, file);
    case MeshFormat::kStl:
      return ReadStl(bytes, file);
    default:
      return ReadPly(bytes, file);
  }
}

bool WriteSoup(MeshFormat format, const PolygonSoup& soup, std::ostream& out) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
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
