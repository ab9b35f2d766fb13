// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/convex_hull.h"

#include <CGAL/convex_hull_3.h>

#include <vector>

#include "core/bounds/cgal_mesh.h"
#include "core/mesh/sorted_mesh.h"

namespace phongpd::internal {

TriangleMesh HullOfVertices(const TriangleMesh& mesh) {
  // No frame: the predicates are exact, and the vertices stay what they are.
  UnitFrame frame(mesh);
  frame.center.setZero();
  frame.scale = 1.0;
  std::vector<CgalPoint> points;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) points.push_back(frame.ToCgal(mesh.vertices[v]));
  }
  CgalMesh hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  // CGAL visits facets in an order that depends on where they lie in memory.
  return SortByCoordinates(FromCgal(hull, frame)).mesh;
}

}  // namespace phongpd::internal
