// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: FCL at many places of each path, on the part as it was drawn in; that
// part within the one drawn by winding numbers; orders known by construction.
#include "planners/solve/removal.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "core/mesh/mesh_error.h"
#include "core/solid/shrunk_solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;

Solid Named(const TriangleMesh& mesh, const std::string& name) {
  return MakeSolid(mesh, name);
}

// Ends beside all others, and meets none of them on the way.
void ExpectWayOut(const Removal& removal, const Solid& part,
                  const std::vector<Solid>& rest) {
  ASSERT_TRUE(removal.IsOut()) << part.name() << ": " << removal.reason;
  ASSERT_FALSE(removal.path.empty());
  EXPECT_EQ(removal.path.front(), Vector3d::Zero());
  const BoundingBox box = ComputeBounds(part);
  const Vector3d end = removal.path.back();
  const Solid moved = removal.granted_least > 0.0
                          ? Shrunk(part, removal.granted_least).solid
                          : part;
  for (const Solid& other : rest) {
    const BoundingBox its = ComputeBounds(other);
    EXPECT_TRUE(((box.min + end).array() > its.max.array()).any() ||
                ((box.max + end).array() < its.min.array()).any())
        << part.name() << " is not beside " << other.name();
    const CollisionOracle oracle(moved, other);
    int hits = 0;
    for (std::size_t i = 0; i + 1 < removal.path.size(); ++i) {
      for (int k = 0; k <= 100; ++k) {
        hits +=
            oracle.Collides(removal.path[i] +
                            0.01 * k * (removal.path[i + 1] - removal.path[i]));
      }
    }
    EXPECT_EQ(hits, 0) << part.name() << " against " << other.name();
  }
}

TEST(ShrunkSolid, LiesWithinWhatItWasAndAsDeepAsIsSaid) {
  const double by = 0.01;
  const std::vector<TriangleMesh> meshes = {Cube(1.0),
                                            MakeL(1, 0.3, 0.5),
                                            MakePlateWithHole(4, 1, 1),
                                            MakeStar(0.5, 1.2),
                                            MakeVessel(4, 3, 0),
                                            MakeTorus(2, 0.6, 12, 6),
                                            MakeWrench(0.5, 12, 12, 8, 8)};
  for (const TriangleMesh& mesh : meshes) {
    const ShrunkSolid shrunk = Shrunk(Named(mesh, "part"), by);
    EXPECT_EQ(shrunk.least, by);
    EXPECT_GE(shrunk.most, by);
    EXPECT_LT(shrunk.most, 20.0 * by);
    const TriangleMesh& inner = shrunk.solid.mesh();
    ASSERT_EQ(inner.vertices.size(), mesh.vertices.size());
    for (const Vector3d& v : inner.vertices) {
      EXPECT_NEAR(testing::WindingNumber(mesh, v), 1.0, 1e-6);
    }
    for (const Triangle& t : mesh.triangles) {
      const Vector3d n = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                             .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
                             .normalized();
      for (const int v : t) {
        EXPECT_LE(n.dot(inner.vertices[v] - mesh.vertices[v]),
                  -by * (1.0 - 1e-9));
      }
    }
  }
  // A cube's corner moves by √3 as far as its faces.
  EXPECT_NEAR(Shrunk(Named(Cube(1.0), "cube"), 0.1).most, 0.1 * std::sqrt(3.0),
              1e-12);
}

TEST(ShrunkSolid, RefusesWhatLeavesNoSolid) {
  const Solid cube = Named(Cube(1.0), "cube");
  testing::ExpectRefused([&] { Shrunk(cube, 0.6); }, "cube: expected walls");
  testing::ExpectRefused([&] { Shrunk(cube, 0.0); }, "cube: expected a way");
  testing::ExpectRefused([&] { Shrunk(cube, NAN); }, "cube: expected a way");
}

TEST(Removal, DrawsAPegOutOfItsHole) {
  const Solid plate = Named(MakePlateWithHole(4, 1, 1), "plate");
  const Solid peg = Named(MakeBox({-0.49, -0.49, -1}, {0.49, 0.49, 1}), "peg");
  const Removal out = RemovePart(peg, {plate});
  ExpectWayOut(out, peg, {plate});
  EXPECT_EQ(out.granted_most, 0.0);
  // Straight along its axis, which is the only way.
  EXPECT_LT(out.path.back().head<2>().norm(), 1.0);
}

TEST(Removal, GrantsAnExactFitNoMoreThanItSays) {
  const Solid plate = Named(MakePlateWithHole(4, 1, 1), "plate");
  const Solid peg = Named(MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1}), "peg");
  const Removal tight = RemovePart(peg, {plate});
  EXPECT_EQ(tight.status, PathStatus::kStartInCollision);
  EXPECT_FALSE(tight.reason.empty());
  RemovalOptions options;
  options.tolerance = 1e-3;
  const Removal out = RemovePart(peg, {plate}, options);
  ExpectWayOut(out, peg, {plate});
  EXPECT_EQ(out.granted_least, 1e-3);
  EXPECT_NEAR(out.granted_most, 1e-3 * std::sqrt(3.0), 1e-12);
}

TEST(Removal, ProvesThatWhatIsLinkedStays) {
  const Solid ring = Named(MakeTorus(2, 0.3, 24, 8), "ring");
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.5707963267948966, Vector3d::UnitX())
          .toRotationMatrix();
  const Solid link = Named(
      Translated(Rotated(MakeTorus(2, 0.3, 24, 8), turn), {2, 0, 0}), "link");
  const Removal none = RemovePart(link, {ring});
  EXPECT_EQ(none.status, PathStatus::kInfeasibleProved);
  EXPECT_TRUE(none.path.empty());
  const Removal ball =
      RemovePart(Named(Cube(1), "ball"), {Named(MakeVessel(4, 3, 0), "shell")});
  EXPECT_EQ(ball.status, PathStatus::kInfeasibleProved);
}

// Unit cells whose lowest corner is (i, j, k) are the part's where `holds` says
// so.
Solid Block(const std::string& name,
            const std::function<bool(int, int, int)>& holds) {
  std::vector<double> ticks;
  for (int i = 0; i <= 7; ++i) ticks.push_back(i);
  std::vector<std::vector<std::string>> layers(
      7, std::vector<std::string>(7, std::string(7, '.')));
  for (int k = 0; k < 7; ++k) {
    for (int j = 0; j < 7; ++j) {
      for (int i = 0; i < 7; ++i) {
        if (holds(i, j, k)) layers[k][j][static_cast<std::size_t>(i)] = '#';
      }
    }
  }
  return Named(MakeCells(ticks, ticks, ticks, layers), name);
}

// A box of ten parts without any play.  A bolt whose foot is below the base and
// the wedge across it above the lid hold all else together.
std::vector<Solid> LockedBox() {
  const auto is_corner = [](int i, int j) {
    return (i == 1 || i == 5) && (j == 1 || j == 5);
  };
  const auto is_shaft = [](int i, int j) { return i == 3 && j >= 2 && j <= 4; };
  std::vector<Solid> parts;
  parts.push_back(Block(
      "base", [&](int i, int j, int k) { return k == 1 && !is_shaft(i, j); }));
  parts.push_back(Block("plate", [&](int i, int j, int k) {
    return k == 2 && !is_corner(i, j) && !is_shaft(i, j);
  }));
  parts.push_back(Block("frame", [](int i, int j, int k) {
    return k == 3 && (i == 0 || i == 6 || j == 0 || j == 6);
  }));
  for (const int x : {1, 5}) {
    for (const int y : {1, 5}) {
      parts.push_back(Block("pin " + std::to_string(parts.size()),
                            [x, y](int i, int j, int k) {
                              return i == x && j == y && (k == 2 || k == 3);
                            }));
    }
  }
  parts.push_back(Block("bolt", [&](int i, int j, int k) {
    if (k == 0) return i >= 2 && i <= 4 && j >= 2 && j <= 4;
    return is_shaft(i, j) && !(k == 5 && j == 3);
  }));
  parts.push_back(Block(
      "lid", [&](int i, int j, int k) { return k == 4 && !is_shaft(i, j); }));
  parts.push_back(Block(
      "wedge", [](int i, int j, int k) { return k == 5 && j == 3 && i >= 1; }));
  return parts;
}

TEST(Disassembly, TakesABoxOfTenPartsApartWedgeFirst) {
  const std::vector<Solid> parts = LockedBox();
  ASSERT_EQ(parts.size(), 10U);
  RemovalOptions options;
  options.tolerance = 0.01;
  const Disassembly apart = Disassemble(parts, options);
  ASSERT_TRUE(apart.IsComplete()) << apart.stuck.front().removal.reason;
  ASSERT_EQ(apart.steps.size(), 9U);
  std::vector<std::size_t> left(parts.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  std::vector<std::string> names;
  for (const Disassembly::Step& step : apart.steps) {
    left.erase(std::find(left.begin(), left.end(), step.part));
    std::vector<Solid> rest;
    for (const std::size_t i : left) rest.push_back(parts[i]);
    ExpectWayOut(step.removal, parts[step.part], rest);
    names.push_back(parts[step.part].name());
  }
  EXPECT_EQ(names[0], "wedge");
  EXPECT_EQ(names[1], "bolt");
}

TEST(Disassembly, ProvesWhichPartsHoldEachOther) {
  const Solid ring = Named(MakeTorus(2, 0.3, 24, 8), "ring");
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.5707963267948966, Vector3d::UnitX())
          .toRotationMatrix();
  const Solid link = Named(
      Translated(Rotated(MakeTorus(2, 0.3, 24, 8), turn), {2, 0, 0}), "link");
  // Beside them as it lies, which is a way of one point.
  const Solid stone = Named(Translated(Cube(1), {0, 0, 5}), "stone");
  const Disassembly apart = Disassemble({ring, link, stone});
  EXPECT_FALSE(apart.IsComplete());
  EXPECT_TRUE(apart.IsProved());
  ASSERT_EQ(apart.steps.size(), 1U);
  EXPECT_EQ(apart.steps[0].part, 2U);
  ASSERT_EQ(apart.stuck.size(), 2U);
  EXPECT_EQ(apart.stuck[0].part, 0U);
  EXPECT_EQ(apart.stuck[1].part, 1U);
}

TEST(Removal, RefusesBadInputBeforeLongWork) {
  const Solid cube = Named(Cube(1), "cube");
  testing::ExpectRefused([&] { RemovePart(cube, {}); }, "cube: expected parts");
  RemovalOptions options;
  options.tolerance = -1.0;
  testing::ExpectRefused([&] { RemovePart(cube, {cube}, options); },
                         "tolerance: expected a number >= 0, found -1");
  testing::ExpectRefused([&] { Disassemble({cube}); },
                         "parts: expected at least 2, found 1");
}

}  // namespace
}  // namespace phongpd
