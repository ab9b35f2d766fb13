// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL 5.5 compiles its Nef polyhedra only before other headers.
// clang-format off
#include "results/bench/competitor_kernel.h"
#include <CGAL/convex_decomposition_3.h>
// clang-format on

#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <Eigen/Geometry>
#include <stdexcept>
#include <utility>
#include <vector>

#include "results/bench/competitors.h"

namespace phongpd::bench {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Point = CompetitorKernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

// Is no vertex above any facet, up to 1e-9 of the size?  Decomposition takes
// the rounding of a ball's quads for hundreds of parts.
bool IsConvex(const TriangleMesh& mesh) {
  const double size = ComputeBounds(mesh).Diagonal();
  for (const auto& [i, j, k] : mesh.triangles) {
    const auto at = [&](int v) {
      return mesh.vertices[static_cast<std::size_t>(v)];
    };
    const Eigen::Vector3d n = (at(j) - at(i)).cross(at(k) - at(i)).normalized();
    for (const Eigen::Vector3d& p : mesh.vertices) {
      if (n.dot(p - at(i)) > 1e-9 * size) return false;
    }
  }
  return true;
}

// The vertices of every convex part.
std::vector<std::vector<Point>> ConvexParts(const TriangleMesh& mesh,
                                            bool reflect) {
  if (IsConvex(mesh)) {
    std::vector<Point> points;
    const double sign = reflect ? -1.0 : 1.0;
    for (const Eigen::Vector3d& v : mesh.vertices) {
      points.emplace_back(sign * v.x(), sign * v.y(), sign * v.z());
    }
    return {points};
  }
  CompetitorNef nef = ToNef(mesh, reflect);
  CGAL::convex_decomposition_3(nef);
  std::vector<std::vector<Point>> parts;
  for (auto volume = ++nef.volumes_begin(); volume != nef.volumes_end();
       ++volume) {
    if (!volume->mark()) continue;
    CompetitorPolyhedron part;
    nef.convert_inner_shell_to_polyhedron(volume->shells_begin(), part);
    parts.emplace_back(part.points_begin(), part.points_end());
  }
  return parts;
}

Mesh HullOfSums(const std::vector<Point>& a, const std::vector<Point>& b) {
  std::vector<Point> sums;
  for (const Point& p : a) {
    for (const Point& q : b) sums.push_back(p + (q - CGAL::ORIGIN));
  }
  Mesh hull;
  CGAL::convex_hull_3(sums.begin(), sums.end(), hull);
  return hull;
}

}  // namespace

CompetitorResult HullUnion(const TriangleMesh& robot,
                           const TriangleMesh& obstacle) {
  const auto a = ConvexParts(robot, true), b = ConvexParts(obstacle, false);
  std::vector<Mesh> meshes;
  for (const auto& p : a) {
    for (const auto& q : b) meshes.push_back(HullOfSums(p, q));
  }
  while (meshes.size() > 1) {
    std::vector<Mesh> larger;
    for (std::size_t i = 0; i + 1 < meshes.size(); i += 2) {
      Mesh both;
      if (!pmp::corefine_and_compute_union(meshes[i], meshes[i + 1], both)) {
        throw std::runtime_error("the union is not manifold");
      }
      larger.push_back(std::move(both));
    }
    if (meshes.size() % 2 == 1) larger.push_back(std::move(meshes.back()));
    meshes = std::move(larger);
  }
  if (meshes.empty()) throw std::runtime_error("no convex part");
  return {meshes[0].number_of_faces(), CGAL::to_double(pmp::volume(meshes[0]))};
}

}  // namespace phongpd::bench
