// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/polygon_triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <cstddef>

namespace phongpd::internal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

enum class Side { kUnknown, kInside, kOutside };
struct FaceInfo {
  Side side = Side::kUnknown;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using SidedFaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, SidedFaceBase>,
    CGAL::No_constraint_intersection_tag>;

// Inserts the loops as constraints; false when they are not simple.
bool InsertLoops(const std::vector<std::vector<Vector2d>>& loops, Cdt* cdt) {
  std::size_t count = 0;
  for (const std::vector<Vector2d>& loop : loops) {
    std::vector<Cdt::Vertex_handle> handles;
    for (const Vector2d& p : loop) {
      handles.push_back(cdt->insert({p.x(), p.y()}));
      handles.back()->info() = static_cast<int>(count);
      if (cdt->number_of_vertices() != ++count) return false;
    }
    for (std::size_t i = 0; i < handles.size(); ++i) {
      try {
        cdt->insert_constraint(handles[i], handles[(i + 1) % handles.size()]);
      } catch (const Cdt::Intersection_of_constraints_exception&) {
        return false;
      }
    }
  }
  return count > 2;
}

// Marks the faces inside or outside, changing at every constraint.
void MarkSides(Cdt* cdt) {
  std::vector<Cdt::Face_handle> open = {cdt->infinite_face()};
  open.back()->info().side = Side::kOutside;
  while (!open.empty()) {
    const Cdt::Face_handle face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      Side& side = face->neighbor(i)->info().side;
      if (side != Side::kUnknown) continue;
      const bool was_inside = face->info().side == Side::kInside;
      side = was_inside != face->is_constrained(i) ? Side::kInside
                                                   : Side::kOutside;
      open.push_back(face->neighbor(i));
    }
  }
}

}  // namespace

std::vector<Triangle> TriangulatePolygon(
    const std::vector<std::vector<Vector2d>>& loops) {
  Cdt cdt;
  if (!InsertLoops(loops, &cdt)) return {};
  MarkSides(&cdt);
  std::vector<Triangle> triangles;
  for (const Cdt::Face_handle face : cdt.finite_face_handles()) {
    if (face->info().side != Side::kInside) continue;
    triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(),
                         face->vertex(2)->info()});
  }
  return triangles;
}

std::vector<Triangle> TriangulatePolygon(const std::vector<Vector3d>& corners) {
  std::vector<Triangle> fan;
  std::vector<Vector3d> normals;
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vector3d to_first = corners[i] - corners[0];
    const Vector3d to_second = corners[i + 1] - corners[0];
    fan.push_back({0, static_cast<int>(i), static_cast<int>(i) + 1});
    normals.push_back(to_first.cross(to_second));
    normal += normals.back();
  }
  bool is_fan_right = true;
  for (const Vector3d& n : normals) is_fan_right &= n.dot(normal) > 0;
  if (is_fan_right || fan.size() < 2) return fan;

  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<Vector2d> loop;
  for (const Vector3d& p : corners) loop.emplace_back(p[u], p[v]);
  std::vector<Triangle> triangles =
      TriangulatePolygon(std::vector<std::vector<Vector2d>>{loop});
  return triangles.size() == fan.size() ? triangles : fan;
}

}  // namespace phongpd::internal
