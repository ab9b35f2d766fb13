// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL 5.5 compiles its Nef polyhedra only before other headers.
// clang-format off
#include "results/bench/competitor_kernel.h"
#include <CGAL/minkowski_sum_3.h>
// clang-format on

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>

#include "results/bench/competitors.h"

namespace phongpd::bench {

namespace pmp = CGAL::Polygon_mesh_processing;

CompetitorResult NefSum(const TriangleMesh& robot,
                        const TriangleMesh& obstacle) {
  CompetitorNef a = ToNef(robot, true), b = ToNef(obstacle, false);
  const CompetitorNef sum = CGAL::minkowski_sum_3(a, b);
  CGAL::Surface_mesh<CompetitorKernel::Point_3> mesh;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(sum, mesh, true);
  return {mesh.number_of_faces(), CGAL::to_double(pmp::volume(mesh))};
}

}  // namespace phongpd::bench
