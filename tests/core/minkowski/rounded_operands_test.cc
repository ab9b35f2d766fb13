// SPDX-License-Identifier: GPL-3.0-or-later
// Solids whose parts are closer than the grid: what rounding collapses, flips
// or lets cross is mended, or refused by name, and never wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/minkowski/operands/grid_solid.h"
#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/contact_membership.h"
#include "tests/support/expect_refused.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

using testing::FindWrongPoint;

TriangleMesh Turned(const TriangleMesh& mesh) {
  return Rotated(mesh, GenericRotation());
}

int Pick(std::size_t count, std::mt19937_64* random) {
  return static_cast<int>((*random)() % count);
}

// Moves a vertex onto, or near, another one, an edge or a facet of its own
// component.
void MoveSomeVertex(TriangleMesh* mesh, std::mt19937_64* random) {
  constexpr double kNear[] = {0.0,   1e-16, 1e-15, 1e-14,
                              1e-13, 1e-12, 1e-11, 1e-10};
  const double scale = ComputeBounds(*mesh).Diagonal();
  const Triangle from = mesh->triangles[Pick(mesh->triangles.size(), random)];
  const Triangle onto = mesh->triangles[Pick(mesh->triangles.size(), random)];
  const int moved = from[Pick(3, random)];
  // Neighbours more often than others: of these most make crossings.
  const Triangle& target = Pick(2, random) == 0 ? from : onto;
  std::uniform_real_distribution<double> uniform(0.05, 1.0);
  Vector3d weights(uniform(*random), uniform(*random), uniform(*random));
  const int kind = Pick(4, random);  // vertex twice, edge, facet
  if (kind == 2) weights[Pick(3, random)] = 0.0;
  if (kind < 2) weights = Vector3d::Unit(Pick(3, random));
  weights /= weights.sum();
  Vector3d p = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) p += weights[k] * mesh->vertices[target[k]];
  const Vector3d offset =
      testing::RandomPoint({-Vector3d::Ones(), Vector3d::Ones()}, random);
  mesh->vertices[moved] = p + kNear[Pick(8, random)] * scale * offset;
}

TriangleMesh SmallSolid(int kind, std::mt19937_64* random) {
  switch (kind) {
    case 0:
      return MakeCone(1.0, 2.0, 8);
    case 1:
      return Turned(MakeCone(1.0, 1.3, 10));
    case 2:
      return MakeIcoBall(1.0, 1);
    case 3:
      return Turned(MakeStar(0.5, 1.2));
    case 4:
      return MakeWrench(0.3, 4, 6, 4, 3);
    case 5:
      return Turned(MakeVessel(2.0, 1.0, 0.0));
    case 8:
      return testing::RandomVoxelSolid(2, 0.6, random);
    case 6:
      return Turned(testing::RandomVoxelSolid(2, 0.6, random));
    default:
      return Turned(MakeTorus(1.0, 0.4, 5, 4));
  }
}
constexpr int kSmallSolids = 9;

struct Tally {
  long built = 0, refused_as_input = 0, refused_on_grid = 0, failures = 0;
};

// One mutated solid against a small robot or obstacle.
void TryMutation(std::uint64_t seed, Tally* tally) {
  std::mt19937_64 random(seed);
  TriangleMesh solid = SmallSolid(Pick(kSmallSolids, &random), &random);
  const int mutations = 1 + Pick(2, &random);
  for (int i = 0; i < mutations; ++i) MoveSomeVertex(&solid, &random);
  try {
    solid = MakeSolid(solid, "solid");
  } catch (const InputError&) {
    ++tally->refused_as_input;
    return;
  }
  const TriangleMesh other = Pick(2, &random) == 0
                                 ? MakeCone(0.3, 0.4, 5)
                                 : Turned(MakeL(0.5, 0.2, 0.3));
  const bool is_robot = Pick(2, &random) == 0;
  const TriangleMesh& robot = is_robot ? solid : other;
  const TriangleMesh& obstacle = is_robot ? other : solid;
  try {
    const ContactSpace space = BuildContactSpace(robot, obstacle);
    ++tally->built;
    std::string wrong;
    if (!space.report().closed) wrong = "not closed";
    if (!space.report().manifold) wrong = "not manifold";
    if (wrong.empty()) {
      wrong = FindWrongPoint(robot, obstacle, space, 16, &random);
    }
    if (wrong.empty()) return;
    ++tally->failures;
    ADD_FAILURE() << "seed " << seed << ": " << wrong;
  } catch (const InputError& error) {
    ++tally->refused_on_grid;
    const std::string text = error.what();
    if (text.find(is_robot ? "robot: " : "obstacle: ") == 0) {
      return;
    }
    ++tally->failures;
    ADD_FAILURE() << "seed " << seed << ": " << text;
  } catch (const std::exception& error) {
    ++tally->failures;
    ADD_FAILURE() << "seed " << seed << ": " << error.what();
  }
}

// ---- What collapses onto one grid point --------------------------------

// The contact space with a small box must be right, whichever operand the
// solid is.
void ExpectRight(const std::string& what, const TriangleMesh& solid) {
  SCOPED_TRACE(what);
  std::mt19937_64 random(1);
  const TriangleMesh box = MakeBox({-0.1, -0.1, -0.1}, {0.2, 0.1, 0.15});
  for (const bool is_robot : {false, true}) {
    const TriangleMesh& robot = is_robot ? solid : box;
    const TriangleMesh& obstacle = is_robot ? box : solid;
    const ContactSpace space = BuildContactSpace(robot, obstacle);
    EXPECT_TRUE(space.report().closed);
    EXPECT_TRUE(space.report().manifold);
    EXPECT_EQ(FindWrongPoint(robot, obstacle, space, 60, &random), "");
  }
}

// Refused as a robot and as an obstacle, in words that name it.
void ExpectRefused(const std::string& what, const TriangleMesh& solid) {
  SCOPED_TRACE(what);
  const TriangleMesh box = MakeBox({-0.1, -0.1, -0.1}, {0.2, 0.1, 0.15});
  for (const bool is_robot : {false, true}) {
    const std::string text = testing::ErrorOf([&] {
      BuildContactSpace(is_robot ? solid : box, is_robot ? box : solid);
    });
    EXPECT_EQ(text.find(is_robot ? "robot: too fine for the grid of "
                                 : "obstacle: too fine for the grid of "),
              0u)
        << text;
    EXPECT_NE(text.find(" at ("), std::string::npos) << text;
  }
}

// Shrinks the parts between vertices towards one of them.
TriangleMesh Gathered(TriangleMesh mesh, const std::vector<int>& vertices,
                      double factor) {
  const Vector3d place = mesh.vertices[vertices[0]];
  for (const int v : vertices) {
    mesh.vertices[v] = place + factor * (mesh.vertices[v] - place);
  }
  return mesh;
}

std::vector<int> Ring(const TriangleMesh& mesh, int v) {
  std::vector<int> ring = {v};
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] == v) ring.push_back(t[(k + 1) % 3]);
    }
  }
  return ring;
}

// On a grid of 2^-30, which holds it exactly.
internal::GridSolid OnFineGrid(const TriangleMesh& mesh) {
  std::vector<internal::GridPoint> points;
  for (const Vector3d& v : mesh.vertices) {
    points.push_back({std::llrint(v[0] * 0x1p30), std::llrint(v[1] * 0x1p30),
                      std::llrint(v[2] * 0x1p30)});
  }
  return internal::MakeGridSolid(points, mesh.triangles, false, "solid");
}

// tests/data/faults/collapsed_edge.off: vertex 4 lies on vertex 3.
TEST(CollapsedOperands, AnEdgeWithoutLengthIsJoined) {
  const TriangleMesh doubled = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}},
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 4}, {2, 0, 4}, {3, 1, 4}, {0, 3, 4}}};
  const TriangleMesh plain = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const internal::GridSolid solid = OnFineGrid(doubled);
  EXPECT_EQ(solid.facets, plain.triangles);  // the lower index is kept
  const TriangleMesh cube = testing::Cube(0.5);
  const ContactSpace expected = BuildContactSpace(cube, plain);
  const ContactSpace found = BuildContactSpace(cube, doubled);
  EXPECT_EQ(found.mesh().triangles, expected.mesh().triangles);
  EXPECT_EQ(found.mesh().vertices, expected.mesh().vertices);
  ExpectRight("as robot and obstacle", doubled);
}

// The roots of a chain of joins depend on its order; what is kept does not.
TEST(CollapsedOperands, ChainsKeepTheirLowestIndexInAnyOrder) {
  const int n = 9;  // a pyramid over a fan whose rim vertices coincide
  std::vector<int> order(n);
  for (int i = 0; i < n; ++i) order[i] = i;
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    std::shuffle(order.begin(), order.end(), random);
    // Corners 0, 1, 2 and a chain of n vertices at the fourth corner.
    TriangleMesh mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 2, 1}}};
    for (int i = 0; i < n; ++i) mesh.vertices.push_back({0, 0, 1});
    const auto at = [&order](int i) { return 3 + order[i]; };
    for (int i = 0; i + 1 < n; ++i) {
      mesh.triangles.push_back({0, at(i), at(i + 1)});
      mesh.triangles.push_back({1, at(i + 1), at(i)});
    }
    mesh.triangles.push_back({0, 1, at(0)});
    mesh.triangles.push_back({1, 2, at(n - 1)});
    mesh.triangles.push_back({2, 0, at(n - 1)});
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    const internal::GridSolid solid = OnFineGrid(mesh);
    EXPECT_EQ(solid.facets.size(), 4u);
    EXPECT_EQ(solid.edges.size(), 6u);
    for (const Triangle& t : solid.facets) {
      for (const int v : t) EXPECT_LE(v, 3);
    }
  }
}

TEST(CollapsedOperands, EdgesTrianglesAndFansAreJoined) {
  const TriangleMesh ball = Turned(MakeIcoBall(1.0, 2));
  const Triangle t = ball.triangles[17];
  for (const double spread : {0.0, 1e-13, 1e-12}) {
    const std::string at =
        " shrunk to " + std::to_string(1e12 * spread) + "e-12";
    ExpectRight("an edge" + at, Gathered(ball, {t[0], t[1]}, spread));
    ExpectRight("a triangle" + at, Gathered(ball, {t[0], t[1], t[2]}, spread));
    ExpectRight("a fan" + at, Gathered(ball, Ring(ball, t[0]), spread));
  }
}

TEST(CollapsedOperands, PartsAreLostOnlyInsideOthers) {
  const TriangleMesh ball = Turned(MakeIcoBall(1.0, 1));
  const TriangleMesh dust = MakeIcoBall(1e-14, 1);
  const TriangleMesh needle =
      Rotated(MakeCone(1e-13, 0.3, 6), GenericRotation());
  const TriangleMesh sheet =
      Rotated(MakePrism(0.2, 1e-13, 6), GenericRotation());
  for (const TriangleMesh& part : {dust, needle, sheet}) {
    ExpectRight("inside", Joined(ball, part));
    ExpectRefused("outside", Joined(ball, Translated(part, {1.5, 0.3, 0.7})));
  }
}

TEST(CollapsedOperands, WallsAndGapsBelowTheGrid) {
  // A slot below the grid fills; the wall beside a cavity may not vanish.
  for (const double gap : {1e-14, 1e-13, 1e-12}) {
    const TriangleMesh slit =
        Joined(MakeBox({0, 0, 0}, {1, 1, 1.0 / 3}),
               MakeBox({0, 0, 1.0 / 3 + gap}, {1, 1, 0.7}));
    ExpectRight("slit", Turned(slit));
  }
  const TriangleMesh thin = MakeBoxShell({0, 0, 0}, {1, 1, 1}, 1e-13);
  try {
    ExpectRight("thin shell", Turned(thin));
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("too fine for the grid"),
              std::string::npos);
  }
}

TEST(CollapsedOperands, AWholeOperandBelowTheGridIsRefused) {
  const std::string what = testing::ErrorOf([&] {
    BuildContactSpace(Turned(testing::Cube(1e-13)), testing::Cube(1.0));
  });
  EXPECT_EQ(what.find("robot: "), 0u) << what;
}

TEST(RoundingCampaign, MutatedSolidsAreBuiltRightOrRefusedByName) {
  const long count = testing::CampaignCases(400, 40000);
  Tally tally;
  for (long i = 0; i < count; ++i) {
    TryMutation(static_cast<std::uint64_t>(1 + i), &tally);
  }
  EXPECT_GT(tally.built, count / 4);
  testing::CampaignRow row;
  row.item = "geometry";
  row.subject = "mutated solids: " + std::to_string(tally.built) + " built, " +
                std::to_string(tally.refused_as_input) +
                " refused as meshes, " + std::to_string(tally.refused_on_grid) +
                " on the grid";
  row.cases = count;
  row.failures = tally.failures;
  row.seed = 1;
  testing::ReportCampaign(row);
}

}  // namespace
}  // namespace phongpd
