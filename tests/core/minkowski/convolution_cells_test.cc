// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the whole convolution, and the same questions without a limit.
#include "core/minkowski/convolution/convolution_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <thread>
#include <vector>

#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/convolution/convolution_space.h"
#include "core/minkowski/operands/grid_pair.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/named_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using testing::Cube;
using testing::NamedPair;

using Corners = std::array<std::array<double, 3>, 3>;

std::vector<NamedPair> Pairs() {
  return {
      {"cubes", Cube(0.5), Cube(1.5)},
      {"star and torus", MakeStar(0.5, 1.2), MakeTorus(2, 0.6, 24, 12)},
      {"ball and wrench", MakeUvBall(0.3, 16, 12), MakeWrench(1, 12, 12, 8, 8)},
      {"cube and hollow shell", Cube(1), MakeVessel(4, 3, 0)},
      {"star and turned vessel", MakeStar(0.3, 0.7),
       Rotated(MakeVessel(3.6, 3, 0.6), GenericRotation())},
      // Four thousand facets share each tip's corner.
      {"cone and cone", MakeCone(0.5, 1, 64), MakeCone(0.8, 1.6, 2000)},
      {"knot and scan", MakeKnot(0.3, 0.12, 32, 6),
       MakeScan(MakeTorus(2, 0.7, 24, 16), 0.3, 0.002, 3)},
  };
}

// A facet by its corners, the least first.
Corners CornersOf(const TriangleMesh& mesh, const Triangle& t) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& q = mesh.vertices[static_cast<std::size_t>(t[k])];
    corners[k] = {q[0], q[1], q[2]};
  }
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()),
              corners.end());
  return corners;
}

std::set<Corners> Facets(const TriangleMesh& mesh) {
  std::set<Corners> facets;
  for (const Triangle& t : mesh.triangles) facets.insert(CornersOf(mesh, t));
  return facets;
}

TEST(ConvolutionCells, HoldTheWholeConvolution) {
  for (const NamedPair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const GridPair grid = MakeGridPair(pair.robot, "a", pair.obstacle, "b");
    const Convolution all =
        ReducedConvolution(grid.obstacle, grid.reflected_robot);
    TriangleMesh mesh;
    for (const GridPoint& p : all.points) mesh.vertices.push_back(ToDouble(p));
    for (const ConvolutionFacet& f : all.facets) {
      mesh.triangles.push_back(f.corners);
    }
    const ConvolutionCells cells(grid.obstacle, grid.reflected_robot,
                                 [] { return HUGE_VAL; });
    EXPECT_EQ(cells.facets(), 0U);
    std::set<Corners> found;
    std::size_t held = 0, leaves = 0;
    cells.NearestFirst(
        1.0, [](const BoxTree::Node&) { return 0.0; },
        [&](const ConvolutionCells::Leaf& leaf) {
          EXPECT_FALSE(leaf.mesh.triangles.empty());
          held += leaf.mesh.triangles.size();
          ++leaves;
          found.merge(Facets(leaf.mesh));
          return 1.0;
        });
    EXPECT_EQ(found, Facets(mesh));
    EXPECT_EQ(cells.facets(), held);
    // Halving ends, and what several cells hold stays a small multiple.
    EXPECT_LT(leaves, 20 + mesh.triangles.size() / 20);
    EXPECT_LT(held, 6 * mesh.triangles.size());
  }
}

// Wherever a segment goes, the facets that it meets are in the cells it meets.
TEST(ConvolutionCells, AnswerAsOneTreeOfAllFacetsDoes) {
  std::mt19937_64 random(8);
  int met = 0;
  for (const NamedPair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const GridPair grid = MakeGridPair(pair.robot, "a", pair.obstacle, "b");
    const ConvolutionSpace space(grid);
    const TriangleMesh mesh = space.Mesh();
    const TriangleBvh tree(mesh);
    const double diagonal = space.Bounds().Diagonal();
    // Close to facets, or anywhere: on them the rounding to the grid decides.
    const auto point = [&]() -> Vector3d {
      const Vector3d any = testing::RandomPoint(space.Bounds(), &random);
      if (random() % 2 == 0) return any;
      const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
      const Vector3d& corner = mesh.vertices[t[random() % 3]];
      return corner + 1e-3 * (any - corner);
    };
    for (int i = 0; i < 400; ++i) {
      const Vector3d a = point();
      const Vector3d b =
          i % 2 == 0 ? point() : Vector3d(a + 0.05 * (point() - a));
      // In the user's frame both are rounded.
      const double contact = space.FirstContact(a, b);
      const TriangleBvh::Hit hit = tree.FirstHit(a, b);
      met += hit.Found() ? 1 : 0;
      if (hit.Found() && contact <= 1.0) {
        EXPECT_NEAR(contact * (b - a).norm(), hit.fraction * (b - a).norm(),
                    1e-9 * diagonal);
      } else if (hit.Found() || contact <= 1.0) {
        EXPECT_LT(tree.Distance(a, b, diagonal), 1e-9 * diagonal);
        EXPECT_LT(space.Distance(a, b, diagonal), 1e-9 * diagonal);
      }
      const double limit = 0.1 * diagonal;
      EXPECT_NEAR(space.Distance(a, b, limit), tree.Distance(a, b, limit),
                  1e-9 * diagonal);
      EXPECT_NEAR(space.FindNearest(a).distance, tree.FindClosest(a).distance,
                  1e-9 * diagonal);
      EXPECT_NEAR((space.FindNearest(a).point - a).norm(),
                  space.FindNearest(a).distance, 1e-9 * diagonal);
    }
  }
  EXPECT_GT(met, 800);
}

// Each question twice: the second time nothing is left to model.
TEST(ConvolutionCells, ModelOnlyWhatQuestionsLeadTo) {
  const TriangleMesh robot = MakeUvBall(0.1, 24, 22), obstacle = MakeWrench();
  const GridPair grid = MakeGridPair(robot, "a", obstacle, "b");
  const ConvolutionSpace space(grid);
  const BoundingBox box = space.Bounds();
  const Vector3d size = box.max - box.min;
  // Outside of the box nothing is modelled, and little along one edge of it.
  EXPECT_TRUE(space.IsFree(box.min - size, box.min - 0.1 * size));
  EXPECT_EQ(space.facets(), 0U);
  const Vector3d corner = box.min + 1e-3 * size;
  EXPECT_TRUE(space.IsFree(corner));
  space.IsFree(corner, corner + Vector3d(0.05 * size[0], 0, 0));
  const std::size_t all = space.Mesh().triangles.size();
  EXPECT_LT(space.facets(), all / 5);
  std::mt19937_64 random(9);
  for (int i = 0; i < 50; ++i) {
    const Vector3d a = testing::RandomPoint(box, &random);
    const Vector3d b = a + 0.1 * (testing::RandomPoint(box, &random) - a);
    const double contact = space.FirstContact(a, b);
    const double distance = space.Distance(a, b, size.norm());
    const auto near = space.FindSeparating(a, b, 0.05, 1e-9);
    const std::size_t facets = space.facets();
    EXPECT_EQ(space.FirstContact(a, b), contact);
    EXPECT_EQ(space.Distance(a, b, size.norm()), distance);
    EXPECT_EQ(space.FindSeparating(a, b, 0.05, 1e-9), near);
    EXPECT_EQ(space.facets(), facets);
  }
}

TEST(ConvolutionCells, AnswerTheSameWithoutRoomToKeepAnything) {
  std::mt19937_64 random(10);
  for (const NamedPair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const GridPair grid = MakeGridPair(pair.robot, "a", pair.obstacle, "b");
    const ConvolutionSpace truth(grid);
    const BoundingBox box = truth.Bounds();
    for (const double max_mib : {0.0, 0.05}) {
      const ConvolutionSpace space(grid, [max_mib] { return max_mib; });
      for (int i = 0; i < 20; ++i) {
        const Vector3d a = testing::RandomPoint(box, &random);
        const Vector3d b = a + 0.3 * (testing::RandomPoint(box, &random) - a);
        EXPECT_EQ(space.IsFree(a, b), truth.IsFree(a, b));
        EXPECT_EQ(space.FirstContact(a, b), truth.FirstContact(a, b));
        EXPECT_EQ(space.FindNearest(a).distance, truth.FindNearest(a).distance);
        EXPECT_EQ(space.Distance(a, b, 0.5), truth.Distance(a, b, 0.5));
        EXPECT_EQ(space.FindSeparating(a, b, 0.05, 1e-9),
                  truth.FindSeparating(a, b, 0.05, 1e-9));
      }
      // 150 bytes a facet, nearly.
      EXPECT_LT(static_cast<double>(space.facets()),
                max_mib * 0x1p20 / 100.0 + 1);
    }
  }
}

TEST(ConvolutionCells, AnswerTheSameToManyThreadsAtOnce) {
  const GridPair grid =
      MakeGridPair(MakeStar(0.5, 1.2), "a", MakeTorus(2, 0.6, 24, 12), "b");
  for (const double max_mib : {0.3, 1e3}) {
    const ConvolutionSpace space(grid, [max_mib] { return max_mib; }),
        truth(grid);
    std::mt19937_64 random(11);
    std::vector<std::pair<Vector3d, Vector3d>> motions;
    std::vector<double> expected;
    for (int i = 0; i < 300; ++i) {
      const Vector3d a = testing::RandomPoint(truth.Bounds(), &random);
      motions.emplace_back(a, testing::RandomPoint(truth.Bounds(), &random));
      expected.push_back(truth.FirstContact(a, motions.back().second));
    }
    std::vector<std::vector<double>> found(4);
    std::vector<std::thread> threads;
    for (std::vector<double>& mine : found) {
      threads.emplace_back([&] {
        for (const auto& [a, b] : motions) {
          mine.push_back(space.FirstContact(a, b));
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::vector<double>& mine : found) EXPECT_EQ(mine, expected);
    if (max_mib > 1.0) {
      EXPECT_EQ(space.facets(), truth.facets());
    }
  }
}

}  // namespace
}  // namespace phongpd::internal
