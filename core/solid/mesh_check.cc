// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/mesh_check.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "core/mesh/counted.h"
#include "core/mesh/edge_sides.h"
#include "core/mesh/finite.h"
#include "core/solid/mesh_defects.h"
#include "core/solid/mesh_examination.h"
#include "core/solid/self_intersection.h"

namespace phongpd {
namespace internal {

std::vector<bool> UsedVertices(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) used[v] = true;
  }
  return used;
}

std::vector<int> SortedByCoordinates(const TriangleMesh& mesh) {
  const std::vector<bool> used = UsedVertices(mesh);
  std::vector<int> order;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) order.push_back(static_cast<int>(v));
  }
  std::sort(order.begin(), order.end(), [&mesh](int i, int j) {
    const Eigen::Vector3d& p = mesh.vertices[i];
    const Eigen::Vector3d& q = mesh.vertices[j];
    return std::make_tuple(p.x(), p.y(), p.z(), i) <
           std::make_tuple(q.x(), q.y(), q.z(), j);
  });
  return order;
}

}  // namespace internal

namespace {

void CountVerticesAndIndices(const TriangleMesh& mesh, MeshReport* report) {
  report->triangles = mesh.triangles.size();
  const int size = static_cast<int>(mesh.vertices.size());
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) report->bad_indices += v < 0 || v >= size;
  }
  for (const Eigen::Vector3d& v : mesh.vertices) {
    report->non_finite_vertices += !IsFinite(v);
  }
  if (report->bad_indices > 0) return;
  const std::vector<bool> used = internal::UsedVertices(mesh);
  report->vertices =
      static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

void CountEdges(const TriangleMesh& mesh, MeshReport* report) {
  using internal::EdgeSide;
  const std::vector<EdgeSide> sides = internal::SortedEdgeSides(
      mesh.triangles, internal::FoldedTriangles::kLeftOut);
  internal::ForEachEdge(sides, [&](std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    report->boundary_edges += count == 1;
    report->non_manifold_edges += count > 2;
    report->misoriented_edges +=
        count == 2 && sides[begin].is_forward == sides[begin + 1].is_forward;
  });
}

void CountDuplicates(const TriangleMesh& mesh, MeshReport* report) {
  std::vector<Triangle> sorted = mesh.triangles;
  for (Triangle& t : sorted) std::sort(t.begin(), t.end());
  std::sort(sorted.begin(), sorted.end());
  const auto last = std::unique(sorted.begin(), sorted.end());
  report->duplicate_triangles = static_cast<std::size_t>(sorted.end() - last);
  if (report->non_finite_vertices > 0) return;
  const std::vector<int> order = internal::SortedByCoordinates(mesh);
  for (std::size_t i = 1; i < order.size(); ++i) {
    report->duplicate_vertices +=
        mesh.vertices[order[i - 1]] == mesh.vertices[order[i]];
  }
}

}  // namespace

namespace internal {

std::size_t BadEdges(const MeshReport& report) {
  return report.boundary_edges + report.non_manifold_edges +
         report.misoriented_edges;
}

MeshReport ExamineTopology(const TriangleMesh& mesh) {
  MeshReport report;
  CountVerticesAndIndices(mesh, &report);
  if (report.bad_indices > 0) return report;
  LabelComponents(mesh, &report.components);
  CountEdges(mesh, &report);
  CountDuplicates(mesh, &report);
  return report;
}

void ExamineGeometry(const TriangleMesh& mesh, MeshReport* report) {
  if (report->bad_indices > 0 || report->non_finite_vertices > 0) return;
  for (const Triangle& triangle : mesh.triangles) {
    report->degenerate_triangles += internal::IsDegenerate(mesh, triangle);
  }
  int count = 0;
  report->self_intersections =
      internal::CountSelfIntersections(mesh, LabelComponents(mesh, &count));
  report->volume = SignedVolume(mesh);
}

void AddWarnings(MeshReport* report) {
  const auto warn = [report](std::size_t count, const char* one,
                             const char* many) {
    if (count == 0) return;
    report->warnings.push_back(Counted(count, one, many));
  };
  warn(report->joined_vertices,
       "vertex joined with another of equal coordinates: the surface was open "
       "or not manifold without.",
       "vertices joined with others of equal coordinates: the surface was "
       "open or not manifold without.");
  warn(static_cast<std::size_t>(report->inverted_components),
       "part was inside out and has been turned.",
       "parts were inside out and have been turned.");
  warn(report->degenerate_triangles, "triangle has no area.",
       "triangles have no area.");
  warn(report->duplicate_vertices, "vertex has the coordinates of another one.",
       "vertices have the coordinates of another one.");
  warn(report->duplicate_triangles,
       "triangle has the same corners as another one.",
       "triangles have the same corners as another one.");
}

void AddCounts(const MeshReport& part, MeshReport* whole) {
  whole->vertices += part.vertices;
  whole->triangles += part.triangles;
  whole->components += part.components;
  whole->degenerate_triangles += part.degenerate_triangles;
  whole->duplicate_vertices += part.duplicate_vertices;
  whole->duplicate_triangles += part.duplicate_triangles;
  whole->joined_vertices += part.joined_vertices;
  whole->inverted_components += part.inverted_components;
  whole->volume += part.volume;
}

}  // namespace internal

MeshReport ExamineMesh(const TriangleMesh& mesh) {
  MeshReport report = internal::ExamineTopology(mesh);
  internal::ExamineGeometry(mesh, &report);
  internal::AddWarnings(&report);
  return report;
}

std::vector<std::string> NamedWarnings(const MeshReport& report,
                                       const std::string& name) {
  std::vector<std::string> lines;
  for (const std::string& line : report.warnings) {
    const bool is_named = line.rfind(name + ": ", 0) == 0;
    lines.push_back(is_named ? line : name + ": " + line);
  }
  return lines;
}

}  // namespace phongpd
