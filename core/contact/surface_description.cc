// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/surface_description.h"

#include <string>

#include "core/mesh/counted.h"
#include "core/mesh/triangle_quality.h"
#include "core/mesh/union_find.h"
#include "core/solid/mesh_check.h"

namespace phongpd::internal {
namespace {

// Does every vertex of a closed, edge-manifold mesh have one fan of triangles?
bool HasManifoldVertices(const TriangleMesh& mesh, std::size_t vertices) {
  const auto neighbors = TriangleNeighbors(mesh);
  UnionFind fans(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Triangle& other = mesh.triangles[neighbors[t][k]];
      for (const int corner : {k, (k + 1) % 3}) {
        for (int j = 0; j < 3; ++j) {
          if (other[j] == mesh.triangles[t][corner]) {
            fans.Join(static_cast<int>(3 * t) + corner,
                      3 * neighbors[t][k] + j);
          }
        }
      }
    }
  }
  std::size_t count = 0;
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    count += fans.Find(static_cast<int>(c)) == static_cast<int>(c);
  }
  return count == vertices;
}

}  // namespace

void DescribeSurface(const TriangleMesh& mesh, ContactSpaceReport* report) {
  const MeshReport found = ExamineMesh(mesh);
  report->triangles = found.triangles;
  report->vertices = found.vertices;
  report->closed = found.boundary_edges == 0;
  report->manifold = report->closed && found.non_manifold_edges == 0 &&
                     HasManifoldVertices(mesh, found.vertices);
  report->components = found.components;
  report->volume = SignedVolume(mesh);
  report->self_intersections = found.self_intersections;
  report->degenerate_triangles = found.degenerate_triangles;
  const QualityFigures quality = MeasureQuality(mesh);
  report->worst_quality = quality.worst;
  report->median_quality = quality.median;
  // χ = V − E + F = 2·components − 2·genus, with E = 3F/2 on a closed mesh.
  const long euler = static_cast<long>(found.vertices) -
                     static_cast<long>(found.triangles) / 2;
  report->genus = static_cast<int>(found.components - euler / 2);
  if (found.self_intersections > 0) {
    report->warnings.push_back(Counted(found.self_intersections,
                                       "pair of triangles meets",
                                       "pairs of triangles meet") +
                               ": the solid touches itself, or vertices "
                               "closer than the rounding to double");
  }
  if (found.degenerate_triangles > 0) {
    report->warnings.push_back(Counted(
        found.degenerate_triangles, "triangle has no area after rounding",
        "triangles have no area after rounding"));
  }
}

}  // namespace phongpd::internal
