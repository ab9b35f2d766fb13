// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/mesh_defects.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::UnitBox;

std::ptrdiff_t CountOf(const std::vector<MeshDefect>& defects,
                       DefectKind kind) {
  return std::count_if(defects.begin(), defects.end(),
                       [kind](const MeshDefect& d) { return d.kind == kind; });
}

TEST(FindDefects, FindsNoneInASolid) {
  EXPECT_TRUE(FindDefects(UnitBox()).empty());
  EXPECT_TRUE(FindDefects(MakeVessel(2, 1, 0.5)).empty());
}

TEST(FindDefects, SaysWhereASurfaceIsOpen) {
  TriangleMesh mesh = UnitBox();
  const Triangle gone = mesh.triangles.back();
  mesh.triangles.pop_back();
  const std::vector<MeshDefect> defects = FindDefects(mesh);
  ASSERT_EQ(defects.size(), 3u);
  for (const MeshDefect& defect : defects) {
    EXPECT_EQ(defect.kind, DefectKind::kOpenEdge);
    EXPECT_EQ(defect.triangles.size(), 1u);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d middle =
        0.5 * (mesh.vertices[static_cast<std::size_t>(gone[k])] +
               mesh.vertices[static_cast<std::size_t>(gone[(k + 1) % 3])]);
    EXPECT_TRUE(
        std::any_of(defects.begin(), defects.end(),
                    [&](const MeshDefect& d) { return d.place == middle; }))
        << middle.transpose();
  }
  EXPECT_EQ(FindDefects(mesh, 2).size(), 2u);
}

TEST(FindDefects, CountsAsExamineMeshDoes) {
  TriangleMesh mesh = MakeIcoBall(1.0, 1);
  mesh.vertices[0] *= -2.0;
  std::swap(mesh.triangles[40][0], mesh.triangles[40][1]);
  mesh.triangles.push_back(mesh.triangles[20]);
  mesh.triangles.erase(mesh.triangles.begin() + 60);
  const MeshReport report = ExamineMesh(mesh);
  const std::vector<MeshDefect> defects = FindDefects(mesh);
  const auto count = [&](DefectKind kind) {
    return static_cast<std::size_t>(CountOf(defects, kind));
  };
  EXPECT_GT(report.boundary_edges, 0u);
  EXPECT_GT(report.non_manifold_edges, 0u);
  EXPECT_GT(report.misoriented_edges, 0u);
  EXPECT_GT(report.self_intersections, 0u);
  EXPECT_EQ(count(DefectKind::kOpenEdge), report.boundary_edges);
  EXPECT_EQ(count(DefectKind::kNonManifoldEdge), report.non_manifold_edges);
  EXPECT_EQ(count(DefectKind::kMisorientedEdge), report.misoriented_edges);
  EXPECT_EQ(count(DefectKind::kSelfIntersection), report.self_intersections);
}

TEST(FindDefects, PutsIntersectionsOnBothTriangles) {
  // A tetrahedron's tip through the opposite face of one part.
  TriangleMesh mesh = MakeIcoBall(1.0, 0);
  mesh.vertices[0] *= -2.0;
  const auto distance = [&](int t, const Vector3d& p) {
    const Triangle& c = mesh.triangles[static_cast<std::size_t>(t)];
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(c[0])];
    const Vector3d n =
        (mesh.vertices[static_cast<std::size_t>(c[1])] - a)
            .cross(mesh.vertices[static_cast<std::size_t>(c[2])] - a)
            .normalized();
    return std::abs(n.dot(p - a));
  };
  int found = 0;
  for (const MeshDefect& defect : FindDefects(mesh)) {
    ASSERT_EQ(defect.kind, DefectKind::kSelfIntersection);
    ASSERT_EQ(defect.triangles.size(), 2u);
    for (const int t : defect.triangles) {
      EXPECT_LE(distance(t, defect.place), 1e-12);
    }
    ++found;
  }
  EXPECT_GT(found, 0);
}

TEST(FindDefects, TakesEqualVerticesForOneWhereThatCloses) {
  TriangleMesh soup;
  for (const Triangle& t : UnitBox().triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (const int v : t) {
      soup.vertices.push_back(UnitBox().vertices[static_cast<std::size_t>(v)]);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_TRUE(FindDefects(soup).empty());
  EXPECT_EQ(SurfaceGenus(soup), 0);
}

TEST(FindDefects, IsSilentAboutWhatHasNoPlaces) {
  TriangleMesh mesh = UnitBox();
  mesh.triangles[0][0] = 99;
  EXPECT_TRUE(FindDefects(mesh).empty());
  EXPECT_EQ(SurfaceGenus(mesh), -1);
  mesh = UnitBox();
  mesh.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(FindDefects(mesh).empty());
}

TEST(SurfaceGenus, CountsHandlesWithHolesClosed) {
  EXPECT_EQ(SurfaceGenus(UnitBox()), 0);
  EXPECT_EQ(SurfaceGenus(MakeTorus(2, 0.5, 9, 7)), 1);
  EXPECT_EQ(
      SurfaceGenus(Joined(MakeTorus(2, 0.5, 9, 7), MakeTorus(9, 0.5, 9, 7))),
      2);
  TriangleMesh open = MakeTorus(2, 0.5, 9, 7);
  open.triangles.pop_back();
  EXPECT_EQ(SurfaceGenus(open), 1);
  open.triangles.push_back(open.triangles.front());
  open.triangles.push_back(open.triangles.front());
  EXPECT_EQ(SurfaceGenus(open), -1);
}

TEST(MakeSolid, SaysWhereTheFirstDefectIsAndHowToMendIt) {
  TriangleMesh mesh = UnitBox();
  mesh.triangles.pop_back();
  const Vector3d place = FindDefects(mesh).front().place;
  std::ostringstream near;
  near << "the first near (" << place[0] << ", " << place[1] << ", " << place[2]
       << ")";
  const std::string what = testing::ErrorOf([&] { MakeSolid(mesh, "box"); });
  EXPECT_NE(what.find(near.str()), std::string::npos) << what;
  EXPECT_NE(what.find("repair safe or wrap"), std::string::npos) << what;
}

}  // namespace
}  // namespace phongpd
