// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::UnitBox;

// Every triangle with its own three vertices.
TriangleMesh Soup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (const int v : t) soup.vertices.push_back(mesh.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

// The message must be one line that starts with the name and says `part`.
void ExpectRefused(const TriangleMesh& mesh, const std::string& part) {
  try {
    MakeSolid(mesh, "part.off");
    ADD_FAILURE() << "accepted; expected: " << part;
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind("part.off: ", 0), 0u) << what;
    EXPECT_NE(what.find(part), std::string::npos) << what << "\n" << part;
    EXPECT_NE(what.find("expected"), std::string::npos) << what;
    EXPECT_NE(what.find("found"), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

TEST(ExamineMesh, FindsNothingInASolid) {
  const MeshReport report = ExamineMesh(MakeTorus(2, 0.5, 9, 7));
  EXPECT_EQ(report.vertices, 63u);
  EXPECT_EQ(report.triangles, 126u);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges +
                report.misoriented_edges + report.degenerate_triangles +
                report.duplicate_vertices + report.duplicate_triangles +
                report.self_intersections,
            0u);
  EXPECT_TRUE(report.warnings.empty());
}

TEST(ExamineMesh, CountsEveryDefect) {
  TriangleMesh mesh = UnitBox();
  mesh.triangles.pop_back();
  EXPECT_EQ(ExamineMesh(mesh).boundary_edges, 3u);

  mesh = UnitBox();
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  EXPECT_EQ(ExamineMesh(mesh).misoriented_edges, 3u);

  mesh = UnitBox();
  const Triangle first = mesh.triangles[0];
  mesh.vertices.emplace_back(0.5, 0.5, 3);
  mesh.triangles.push_back({first[0], first[1], 8});  // a fin
  MeshReport report = ExamineMesh(mesh);
  EXPECT_EQ(report.non_manifold_edges, 1u);
  EXPECT_EQ(report.boundary_edges, 2u);

  mesh = UnitBox();
  mesh.triangles.push_back({first[1], first[2], first[0]});
  report = ExamineMesh(mesh);
  EXPECT_EQ(report.duplicate_triangles, 1u);
  EXPECT_EQ(report.non_manifold_edges, 3u);

  report = ExamineMesh(Soup(UnitBox()));
  EXPECT_EQ(report.vertices, 36u);
  EXPECT_EQ(report.components, 12);
  EXPECT_EQ(report.duplicate_vertices, 28u);
  EXPECT_EQ(report.boundary_edges, 36u);

  mesh = UnitBox();
  mesh.triangles.push_back({0, 8, -1});
  mesh.triangles.push_back({0, 1, 2000000000});
  EXPECT_EQ(ExamineMesh(mesh).bad_indices, 3u);

  mesh = UnitBox();
  mesh.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  mesh.vertices[5].z() = -std::numeric_limits<double>::infinity();
  report = ExamineMesh(mesh);
  EXPECT_EQ(report.non_finite_vertices, 2u);
  EXPECT_EQ(report.boundary_edges, 0u);
}

TEST(ExamineMesh, SurvivesEmptyAndAllEqualInput) {
  EXPECT_EQ(ExamineMesh(TriangleMesh{}).triangles, 0u);
  TriangleMesh point;
  point.vertices.resize(3, Vector3d(1, 2, 3));
  point.triangles = {{0, 1, 2}, {0, 0, 0}, {2, 1, 0}};
  const MeshReport report = ExamineMesh(point);
  EXPECT_EQ(report.degenerate_triangles, 3u);
  EXPECT_EQ(report.duplicate_vertices, 2u);
  EXPECT_EQ(report.self_intersections, 0u);
}

// Of 327,680 triangles there are 5e10 pairs: who looked at all of them would
// not end within the minutes that a test may take.
TEST(ExamineMesh, LooksAtFewOfAllPairs) {
  const TriangleMesh ball = Rotated(MakeIcoBall(1, 7), GenericRotation());
  EXPECT_EQ(ExamineMesh(ball).self_intersections, 0u);
}

TEST(MakeSolid, RefusesByNameAndCount) {
  ExpectRefused(TriangleMesh{}, "expected triangles, found none");
  TriangleMesh mesh = UnitBox();
  mesh.triangles[0][0] = 8;
  ExpectRefused(mesh, "1 indices out of range");
  mesh = UnitBox();
  mesh.vertices[0].x() = std::numeric_limits<double>::infinity();
  ExpectRefused(mesh, "1 vertices with NaN or infinity");
  mesh = UnitBox();
  mesh.triangles.resize(10);
  ExpectRefused(mesh, "open (4 boundary edges)");
  mesh = UnitBox();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  ExpectRefused(mesh, "inconsistently oriented (3 edges");
  mesh = UnitBox();
  for (int t = 0; t < 12; ++t) mesh.triangles.push_back(mesh.triangles[t]);
  ExpectRefused(mesh, "non-manifold (18 edges");
  ExpectRefused(mesh, "12 duplicate triangles");
  mesh = MakeIcoBall(1, 2);
  mesh.vertices[0] *= -1.5;
  ExpectRefused(mesh, std::to_string(ExamineMesh(mesh).self_intersections) +
                          " pairs of triangles");
}

TEST(MakeSolid, RefusesPartsWithoutVolume) {
  TriangleMesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.3}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  // Its two sides coincide, which the exact test sees first.
  ExpectRefused(sheet, "1 pair of triangles");
  TriangleMesh needle = sheet;
  needle.vertices[2] = {0.5, 0, 0};
  ExpectRefused(needle, "none of them with an area");
  needle.triangles = {{0, 0, 1}, {1, 1, 1}};
  ExpectRefused(needle, "none of them with an area");
  // A solid flattened below what rounding can tell from a sheet.
  TriangleMesh flat = MakeIcoBall(1, 1);
  for (Vector3d& v : flat.vertices) v.z() *= 1e-17;
  ExpectRefused(Joined(UnitBox(), flat), "1 of 2 parts");
}

TEST(MakeSolid, RefusesSizesThatLoseDigits) {
  ExpectRefused(Scaled(UnitBox(), 1e-90), "size out of range");
  ExpectRefused(Scaled(UnitBox(), 1e90), "size out of range");
  for (const double scale : {1e-79, 1e-9, 1e9, 1e79}) {
    EXPECT_EQ(
        MakeSolid(Scaled(MakeStar(1, 2), scale), "star").mesh().vertices.size(),
        32u);
  }
}

TEST(MakeSolid, WorksFarFromTheOrigin) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {0.25, 0.5, 1});
  for (const double offset : {1e6, -1e9}) {
    MeshReport report;
    MakeSolid(Translated(Reversed(box), Vector3d::Constant(offset)), "box",
              &report);
    EXPECT_EQ(report.volume, 0.125);
    EXPECT_EQ(report.inverted_components, 1);
  }
}

TEST(MakeSolid, JoinsVerticesOnlyWhereThatCloses) {
  MeshReport report;
  const TriangleMesh box = MakeSolid(Soup(UnitBox()), "soup", &report);
  EXPECT_EQ(box.vertices.size(), 8u);
  EXPECT_EQ(report.joined_vertices, 28u);
  EXPECT_EQ(report.boundary_edges, 0u);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("28 vertices joined"), std::string::npos);

  // Two boxes that touch along an edge are closed as they are; joining them
  // would make that edge non-manifold.
  const TriangleMesh touching =
      Joined(UnitBox(), Translated(UnitBox(), {1, 1, 0}));
  EXPECT_EQ(MakeSolid(touching, "touching", &report).mesh().vertices.size(),
            16u);
  EXPECT_EQ(report.joined_vertices, 0u);
  EXPECT_EQ(report.duplicate_vertices, 2u);
  EXPECT_EQ(report.components, 2);

  TriangleMesh open = Soup(UnitBox());
  open.triangles.pop_back();
  ExpectRefused(open, "open (3 boundary edges), after joining 25 equal");
}

TEST(MakeSolid, LeavesOutFoldedTrianglesAndUnusedVertices) {
  TriangleMesh mesh = UnitBox();
  mesh.vertices.emplace_back(7, 7, 7);
  mesh.triangles.insert(mesh.triangles.begin(), {3, 3, 5});
  MeshReport report;
  const TriangleMesh solid = MakeSolid(mesh, "box", &report);
  EXPECT_EQ(solid.triangles, UnitBox().triangles);
  EXPECT_EQ(solid.vertices.size(), 8u);
  EXPECT_EQ(report.degenerate_triangles, 1u);
  EXPECT_EQ(report.warnings.size(), 1u);
}

TEST(MakeSolid, KeepsZeroAreaTrianglesThatTheSurfaceNeeds) {
  TriangleMesh mesh = UnitBox();
  // Split an edge at its middle on one side only; close with a flat triangle.
  const auto [a, b, c] = mesh.triangles[0];
  mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
  mesh.triangles[0] = {a, 8, c};
  mesh.triangles.push_back({8, b, c});
  mesh.triangles.push_back({a, b, 8});
  MeshReport report;
  EXPECT_EQ(MakeSolid(mesh, "box", &report).mesh().triangles.size(), 14u);
  EXPECT_EQ(report.degenerate_triangles, 1u);
  EXPECT_NEAR(report.volume, 1, 1e-15);
}

TEST(MakeSolid, TurnsInsideOutParts) {
  MeshReport report;
  const TriangleMesh solid =
      MakeSolid(Joined(UnitBox(), Reversed(Translated(UnitBox(), {5, 0, 0}))),
                "two", &report);
  EXPECT_EQ(report.inverted_components, 1);
  EXPECT_EQ(report.volume, 2.0);
  EXPECT_EQ(SignedVolume(solid), 2.0);
  EXPECT_EQ(report.warnings.size(), 1u);
}

// Nested boxes of side 2·size around the origin, outward or inward.
TriangleMesh Nest(const std::vector<std::pair<double, bool>>& shells) {
  TriangleMesh mesh;
  for (const auto& [size, is_outward] : shells) {
    const TriangleMesh box =
        MakeBox(Vector3d::Constant(-size), Vector3d::Constant(size));
    mesh = Joined(mesh, is_outward ? box : Reversed(box));
  }
  return mesh;
}

TEST(MakeSolid, KeepsCavitiesAlsoOfMirroredFiles) {
  struct Case {
    std::vector<std::pair<double, bool>> shells;
    double eighth_volume;
    int turned;
  };
  const std::vector<Case> cases = {
      {{{4, true}, {3, false}}, 64 - 27, 0},                 // a cavity
      {{{4, false}, {3, true}}, 64 - 27, 2},                 // mirrored
      {{{3, true}, {4, false}}, 64 - 27, 2},                 // order is free
      {{{4, true}, {3, false}, {2, true}}, 64 - 27 + 8, 0},  // an island
      {{{4, false}, {3, true}, {2, false}}, 64 - 27 + 8, 3},
      {{{4, true}, {3, false}, {2, false}}, 64 - 27 + 8, 1},  // wrong island
      {{{4, true}, {3, true}}, 64 + 27, 0},    // overlap: union is meant
      {{{4, false}, {3, false}}, 64 + 27, 2},  // the same, mirrored
  };
  for (const Case& c : cases) {
    MeshReport report;
    MakeSolid(Nest(c.shells), "nest", &report);
    EXPECT_DOUBLE_EQ(report.volume, 8 * c.eighth_volume);
    EXPECT_EQ(report.inverted_components, c.turned);
  }
}

TEST(MakeSolid, TurnsPartsThatAreOnlyPartlyInside) {
  // The bounding box of the ball is inside, a corner of the L's notch is not.
  const TriangleMesh l = MakeL(4, 1, 4);
  const TriangleMesh ball = MakeIcoBall(0.5, 1);
  MeshReport report;
  MakeSolid(Joined(l, Reversed(Translated(ball, {1, 2, 2}))), "x", &report);
  EXPECT_EQ(report.inverted_components, 1);  // crosses the wall
  MakeSolid(Joined(l, Reversed(Translated(ball, {3, 3, 2}))), "x", &report);
  EXPECT_EQ(report.inverted_components, 1);  // in the notch
  MakeSolid(Joined(l, Reversed(Scaled(Translated(ball, {1, 1, 4}), 0.5))), "x",
            &report);
  EXPECT_EQ(report.inverted_components, 0);  // in the wall: a cavity
}

TEST(MakeSolid, AcceptsPartsThatShareOneVertex) {
  TriangleMesh two = Joined(UnitBox(), Translated(UnitBox(), {1, 1, 1}));
  // Which vertex of the second box is the corner of the first?
  int first = -1, second = -1;
  for (int v = 0; v < 16; ++v) {
    if (two.vertices[v] == Vector3d(1, 1, 1)) (v < 8 ? first : second) = v;
  }
  for (Triangle& t : two.triangles) {
    for (int& v : t) v = v == second ? first : v;
  }
  MeshReport report;
  MakeSolid(two, "pinched", &report);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.volume, 2.0);
  for (int t = 12; t < 24; ++t)
    std::swap(two.triangles[t][0], two.triangles[t][1]);
  MakeSolid(two, "pinched", &report);
  EXPECT_EQ(report.inverted_components, 1);
  EXPECT_EQ(report.volume, 2.0);
}

TEST(MakeSolid, AcceptsOverlappingParts) {
  const TriangleMesh bars = Joined(MakeBox({-2, -0.2, -0.2}, {2, 0.2, 0.2}),
                                   MakeBox({-0.2, -2, -0.2}, {0.2, 2, 0.2}));
  MeshReport report;
  MakeSolid(bars, "bars", &report);
  EXPECT_EQ(report.components, 2);
  EXPECT_EQ(report.self_intersections, 0u);
}

TEST(MakeSolid, FillsTheReportBeforeItRefuses) {
  TriangleMesh mesh = UnitBox();
  mesh.triangles.pop_back();
  MeshReport report;
  EXPECT_THROW(MakeSolid(mesh, "open", &report), InputError);
  EXPECT_EQ(report.boundary_edges, 3u);
  EXPECT_EQ(report.triangles, 11u);
}

}  // namespace
}  // namespace phongpd
