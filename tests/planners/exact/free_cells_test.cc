// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: CGAL's exact predicates, triangle by triangle, and flood fill.
#include "planners/exact/free_cells.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <random>

#include "core/bvh/triangle_bvh.h"
#include "planners/exact/contact_surface_planner.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"
#include "tests/support/voxel_world.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 Point(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

std::vector<int> TrianglesMet(const TriangleMesh& mesh, const Vector3d& a,
                              const Vector3d& b) {
  std::vector<int> met;
  const Kernel::Segment_3 segment(Point(a), Point(b));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& v = mesh.triangles[t];
    if (CGAL::do_intersect(segment,
                           Kernel::Triangle_3(Point(mesh.vertices[v[0]]),
                                              Point(mesh.vertices[v[1]]),
                                              Point(mesh.vertices[v[2]])))) {
      met.push_back(static_cast<int>(t));
    }
  }
  return met;
}

// The ray is free between its ends; a little longer it meets the triangles it
// names and no other; and nothing of its own piece is on the rest of its line.
void CheckRay(const TriangleMesh& mesh, const FreeCells& cells,
              const CellRay& ray, double step) {
  if (ray.end == CellRay::End::kUndecided || ray.end == CellRay::End::kShell) {
    return;
  }
  const Vector3d d = (ray.to - ray.from).normalized() * step;
  const bool from_surface = ray.from_triangle >= 0;
  const bool to_surface = ray.end == CellRay::End::kSurface;
  const Vector3d a = from_surface ? Vector3d(ray.from + d) : ray.from;
  const Vector3d b = to_surface ? Vector3d(ray.to - d) : ray.to;
  EXPECT_TRUE(TrianglesMet(mesh, a, b).empty());
  if (from_surface) {
    EXPECT_EQ(TrianglesMet(mesh, ray.from - d, b),
              std::vector<int>{ray.from_triangle});
    const double far = 10.0 * ComputeBounds(mesh).Diagonal() / step;
    for (const int t : TrianglesMet(mesh, a, ray.from + far * d)) {
      EXPECT_NE(cells.piece()[t], cells.piece()[ray.from_triangle]);
    }
  }
  if (to_surface) {
    EXPECT_EQ(TrianglesMet(mesh, a, ray.to + d),
              std::vector<int>{ray.to_triangle});
  }
}

void CheckCertificate(const TriangleMesh& mesh, const FreeCells& cells,
                      const CellCertificate& certificate, double step) {
  CheckRay(mesh, cells, certificate.ray, step);
  if (certificate.pieces.empty()) {
    EXPECT_EQ(certificate.cell, FreeCells::kOutside);
    return;
  }
  int piece = cells.piece()[certificate.ray.to_triangle];
  for (std::size_t i = 0; i < certificate.pieces.size(); ++i) {
    ASSERT_EQ(certificate.pieces[i], piece);
    const CellRay& ray = certificate.rays[i];
    EXPECT_EQ(cells.piece()[ray.from_triangle], piece);
    CheckRay(mesh, cells, ray, step);
    if (ray.end == CellRay::End::kSurface) {
      piece = cells.piece()[ray.to_triangle];
    } else {
      EXPECT_EQ(i + 1, certificate.pieces.size());
      EXPECT_EQ(certificate.cell,
                ray.end == CellRay::End::kShell ? piece : FreeCells::kOutside);
    }
  }
}

TEST(FreeCells, GiveCertificatesThatExactPredicatesConfirm) {
  std::mt19937_64 random(4);
  int rays = 0, longest = 0;
  for (int i = 0; i < 24; ++i) {
    // Islands in long chains, and cells within cells.
    auto world = testing::MakeVoxelWorld(
        5, i < 16 ? 0.08 : 0.4, i % 2 == 0 ? 0.3 : 1e-3, i % 3 != 0, &random);
    const Eigen::Matrix3d rotation =
        i % 4 < 2 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                  : testing::RandomRotation(&random);
    for (Vector3d& v : world.contact_space.vertices) v = rotation * v;
    const ContactSurfacePlanner planner(
        TakeAsContactSpace(world.contact_space));
    const Vector3d start = rotation * world.centers.front();
    const Vector3d goal = rotation * world.centers.back();
    const PlanResult result = planner.Plan(start, goal);
    for (const CellCertificate& c : {result.start, result.goal}) {
      CheckCertificate(world.contact_space, planner.cells(), c, 1e-9);
      rays += 1 + static_cast<int>(c.rays.size());
      longest = std::max(longest, static_cast<int>(c.rays.size()));
    }
  }
  EXPECT_GT(rays, 80);
  EXPECT_GT(longest, 1);
}

TEST(FreeCells, CountShellsAndIslands) {
  // A vessel with a ball in its cavity and one beside it.
  TriangleMesh mesh = MakeVessel(10.0, 6.0, 0.0);
  for (const double x : {0.0, 20.0}) {
    const TriangleMesh ball = Translated(MakeIcoBall(1.0, 1), {x, 0.1, 0.2});
    const int first = static_cast<int>(mesh.vertices.size());
    for (const Vector3d& v : ball.vertices) mesh.vertices.push_back(v);
    for (const Triangle& t : ball.triangles) {
      mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  const auto neighbors = TriangleNeighbors(mesh);
  const TriangleBvh segments(mesh);
  const FreeCells cells(mesh, neighbors, segments);
  ASSERT_EQ(cells.piece_count(), 4);
  int shells = 0, outside = 0;
  for (int i = 0; i < 4; ++i) {
    shells += cells.rays()[i].end == CellRay::End::kShell;
    outside += cells.CellOfPiece(i) == FreeCells::kOutside;
  }
  EXPECT_EQ(shells, 1);
  EXPECT_EQ(outside, 2);
  CellRay ray;
  EXPECT_GE(cells.CellOf({0.0, 2.0, 0.0}, &ray), 0);
  EXPECT_EQ(cells.CellOf({20.0, 2.0, 0.0}, &ray), FreeCells::kOutside);
}

}  // namespace
}  // namespace phongpd
