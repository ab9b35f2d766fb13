// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/mesh_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/bounds/mesh_approximation.h"
#include "core/bvh/triangle_bvh.h"
#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

TriangleMesh Box() { return MakeBox({-1, -1, -1}, {1, 1, 1}); }

Triangle Turned(const Triangle& t) { return {t[0], t[2], t[1]}; }

// Every triangle with vertices of its own, as in a file of triangles.
TriangleMesh Apart(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (const Triangle& t : mesh.triangles) {
    const int n = static_cast<int>(out.vertices.size());
    for (const int v : t) out.vertices.push_back(mesh.vertices[v]);
    out.triangles.push_back({n, n + 1, n + 2});
  }
  return out;
}

TriangleMesh Shuffled(TriangleMesh mesh, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  return mesh;
}

TriangleMesh Safe(const TriangleMesh& mesh, RepairReport* report) {
  return RepairSolid(mesh, "part", Repair::kSafe, kRepairAlpha, nullptr,
                     report);
}

TEST(RepairSafely, LeavesSolidsAsTheyAre) {
  for (const TriangleMesh& solid :
       {Box(), MakeWrench(), MakeVessel(4, 3, 0),
        Joined(Box(), MakeBox({0, 0, 0}, {2, 2, 2}))}) {
    RepairReport report;
    const TriangleMesh same = RepairSafely(solid, &report);
    EXPECT_EQ(same.vertices, solid.vertices);
    EXPECT_TRUE(report.actions.empty()) << report.actions.front();
    EXPECT_EQ(SignedVolume(same), SignedVolume(solid));
  }
}

TEST(RepairSafely, RemovesDuplicateFacesOfADoubledBox) {
  for (const TriangleMesh& doubled :
       {Joined(Box(), Box()), Shuffled(Joined(Box(), Box()), 1),
        Shuffled(Apart(Joined(Box(), Box())), 2)}) {
    RepairReport report;
    const TriangleMesh solid = Safe(doubled, &report);
    EXPECT_EQ(solid.triangles.size(), 12U);
    EXPECT_EQ(SignedVolume(solid), 8.0);
    EXPECT_EQ(report.duplicate_faces, 12U);
    EXPECT_EQ(report.mirrored_faces, 0U);
    EXPECT_FALSE(report.actions.empty());
  }
}

TEST(RepairSafely, KeepsOneSideOfATwoSidedBox) {
  TriangleMesh two_sided = Box();
  for (const Triangle& t : Box().triangles) {
    two_sided.triangles.push_back(Turned(t));
  }
  RepairReport report;
  EXPECT_EQ(std::abs(SignedVolume(Safe(two_sided, &report))), 8.0);
  EXPECT_EQ(report.duplicate_faces, 12U);
}

TEST(RepairSafely, RemovesTheWallBetweenTouchingBoxes) {
  const TriangleMesh boxes =
      Joined(MakeBox({0, 0, 0}, {1, 1, 1}), MakeBox({1, 0, 0}, {2, 1, 1}));
  TriangleMesh glued = boxes;
  // Make the wall's diagonals agree: the mirror image of the first box.
  for (std::size_t t = 0; t < 12; ++t) {
    Triangle m = boxes.triangles[t];
    for (int& v : m) v += 8;
    glued.triangles[12 + t] = Turned(m);
  }
  for (std::size_t v = 0; v < 8; ++v) {
    glued.vertices[8 + v] = glued.vertices[v];
    glued.vertices[8 + v].x() = 2.0 - glued.vertices[v].x();
  }
  RepairReport report;
  const TriangleMesh solid = Safe(Shuffled(glued, 4), &report);
  EXPECT_EQ(report.mirrored_faces, 4U);
  EXPECT_EQ(report.joined_vertices, 4U);
  EXPECT_EQ(solid.triangles.size(), 20U);
  EXPECT_EQ(SignedVolume(solid), 2.0);
}

TEST(RepairSafely, KeepsFacesThatOverlappingPartsShare) {
  // Both boxes have the face x = 1, in the same direction: neither may lose
  // it.
  const TriangleMesh boxes =
      Joined(MakeBox({0, 0, 0}, {1, 1, 1}), MakeBox({0.5, 0, 0}, {1, 1, 1}));
  RepairReport report;
  const TriangleMesh solid = Safe(boxes, &report);
  EXPECT_EQ(solid.triangles.size(), 24U);
  EXPECT_EQ(report.duplicate_faces, 0U);
}

TEST(RepairSafely, TurnsFacesLikeTheirNeighbours) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20; ++i) {
    TriangleMesh mesh = i % 2 ? MakeWrench() : MakeVessel(4, 3, 0);
    const double volume = SignedVolume(mesh);
    std::size_t turned = 0;
    std::bernoulli_distribution flip(0.2);
    for (Triangle& t : mesh.triangles) {
      if (!flip(random)) continue;
      t = Turned(t);
      ++turned;
    }
    EXPECT_THROW(MakeSolid(mesh, "flipped"), InputError);
    RepairReport report;
    EXPECT_NEAR(SignedVolume(Safe(mesh, &report)), volume, 1e-12);
    EXPECT_EQ(report.turned_faces, turned);
  }
}

TEST(RepairSafely, RemovesFacesWithoutAreaThatNothingNeeds) {
  TriangleMesh mesh = Box();
  mesh.vertices.push_back({0, -1, -1});  // on an edge of the box
  mesh.triangles.push_back({0, 8, 1});
  mesh.triangles.push_back({2, 2, 5});
  RepairReport report;
  const TriangleMesh solid = Safe(mesh, &report);
  EXPECT_EQ(SignedVolume(solid), 8.0);
  EXPECT_EQ(solid.triangles.size(), 12U);
}

TEST(RepairSolid, RefusesWhatOnlyAWrapCanMend) {
  TriangleMesh open = Box();
  open.triangles.pop_back();
  TriangleMesh crossing = MakeIcoBall(1.0, 1);
  crossing.vertices[0] *= -2.0;
  TriangleMesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  TriangleMesh pillow = sheet;
  pillow.triangles.push_back({0, 2, 1});
  pillow.triangles.push_back({0, 3, 2});
  TriangleMesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  for (const TriangleMesh& bad : {open, crossing, sheet, pillow, one}) {
    for (const Repair repair : {Repair::kReject, Repair::kSafe}) {
      const std::string what =
          testing::ErrorOf([&] { RepairSolid(bad, "part.off", repair); });
      EXPECT_EQ(what.rfind("part.off: ", 0), 0U) << what;
      EXPECT_NE(what.find_first_of("123456789"), std::string::npos) << what;
    }
    RepairReport report;
    MeshReport found;
    const TriangleMesh solid = RepairSolid(bad, "part.off", Repair::kWrap,
                                           kRepairAlpha, &found, &report);
    EXPECT_TRUE(report.is_wrapped);
    EXPECT_GT(report.wrap_bound, 0.0);
    EXPECT_LT(report.wrap_bound, 0.1 * ComputeBounds(bad).Diagonal());
    EXPECT_FALSE(report.wrap_reason.empty());
    const TriangleBvh inside(solid);
    for (const Triangle& t : bad.triangles) {
      for (const int v : t) {
        EXPECT_EQ(inside.Locate(bad.vertices[v]), Location::kInside);
      }
    }
  }
}

TEST(RepairSolid, WrapsNothingThatNeedsNone) {
  RepairReport report;
  const TriangleMesh solid =
      RepairSolid(Box(), "box", Repair::kWrap, kRepairAlpha, nullptr, &report);
  EXPECT_FALSE(report.is_wrapped);
  EXPECT_EQ(SignedVolume(solid), 8.0);
}

TEST(RepairSolid, RefusesWhatHasNoSurface) {
  TriangleMesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.triangles = {{0, 1, 2}};
  TriangleMesh nan = Box();
  nan.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh index = Box();
  index.triangles[0][0] = 99;
  for (const TriangleMesh& bad : {line, nan, index, TriangleMesh()}) {
    for (const Repair repair :
         {Repair::kReject, Repair::kSafe, Repair::kWrap}) {
      EXPECT_THROW(RepairSolid(bad, "part", repair), InputError);
    }
  }
}

TEST(RepairSolid, MakesASolidOfRandomSoups) {
  std::mt19937_64 random(17);
  for (int i = 0; i < 10; ++i) {
    TriangleMesh soup;
    for (int v = 0; v < 12; ++v) {
      soup.vertices.push_back(testing::RandomPoint(
          {Vector3d(-1, -1, -1), Vector3d(1, 1, 1)}, &random));
    }
    std::uniform_int_distribution<int> pick(0, 11);
    for (int t = 0; t < 20; ++t) {
      soup.triangles.push_back({pick(random), pick(random), pick(random)});
    }
    EXPECT_THROW(RepairSolid(soup, "soup", Repair::kSafe), InputError);
    RepairReport report;
    const TriangleMesh solid =
        RepairSolid(soup, "soup", Repair::kWrap, 0.1, nullptr, &report);
    EXPECT_GT(SignedVolume(solid), 0.0);
    EXPECT_TRUE(report.is_wrapped);
  }
}

}  // namespace
}  // namespace phongpd
