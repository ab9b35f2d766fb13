// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the whole convolution, the whole contact space, and exact motion
// checks on it.
#include "core/minkowski/windows/window_cells.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "core/minkowski/convolution/convolution_space.h"
#include "core/minkowski/operands/grid_pair.h"
#include "problems/shapes/shapes.h"
#include "tests/support/facet_corners.h"
#include "tests/support/solid_tools.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using testing::AllCorners;
using testing::Cube;
using testing::FacetCorners;

struct Pair {
  const char* name;
  TriangleMesh robot, obstacle;
};

std::vector<Pair> Pairs() {
  return {
      {"ball and cone", MakeIcoBall(0.5, 1), MakeCone(0.8, 1.6, 12)},
      {"star and torus", MakeStar(0.5, 1.2), MakeTorus(2, 0.6, 12, 6)},
      {"cube and hollow shell", Cube(1), MakeVessel(4, 3, 0)},
      {"L and U", MakeL(1, 0.3, 0.5), MakeU(2, 0.5, 1)},
      {"peg and its hole", MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1}),
       MakePlateWithHole(4, 1, 1)},
      {"star and turned vessel", MakeStar(0.3, 0.7),
       Rotated(MakeVessel(3.6, 3, 0.6), GenericRotation())},
  };
}

TEST(FeatureSums, TellTheWholeConvolutionInItsBox) {
  for (const Pair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const GridPair grid = MakeGridPair(pair.robot, "a", pair.obstacle, "b");
    const FeatureSums sums(grid.obstacle, grid.reflected_robot);
    const Convolution all =
        ReducedConvolution(grid.obstacle, grid.reflected_robot);
    const WindowConvolution part = sums.Within(sums.bounds());
    ASSERT_EQ(part.origins.size(), part.convolution.facets.size());
    const std::set<FacetCorners> expected = AllCorners(all);
    EXPECT_EQ(expected, AllCorners(part.convolution));

    // In a smaller box: all that touch it, by the boxes of those that do not.
    std::mt19937_64 random(3);
    for (int i = 0; i < 5; ++i) {
      BoundingBox box;
      box.min = box.max = testing::RandomPoint(sums.bounds(), &random);
      box.max += 0.1 * (sums.bounds().max - sums.bounds().min);
      const std::set<FacetCorners> there =
          AllCorners(sums.Within(box).convolution);
      for (const FacetCorners& t : there) EXPECT_EQ(expected.count(t), 1U);
      for (const FacetCorners& t : expected) {
        EXPECT_TRUE(there.count(t) != 0 || !testing::IsSeenIn(t, box));
      }
    }
  }
}

TEST(WindowCells, JoinedShowTheWholeContactSpace) {
  for (const Pair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const ContactSpace space = BuildContactSpace(pair.robot, pair.obstacle);
    const GridPair grid = MakeGridPair(pair.robot, "a", pair.obstacle, "b");
    const FeatureSums sums(grid.obstacle, grid.reflected_robot);
    const SolidCollision judge(grid.obstacle, grid.reflected_robot);
    const BuildLimits limits{ContactSpaceOptions()};
    constexpr int kCuts = 3;
    const auto wall = [&](int axis, int i) {
      const double low = sums.bounds().min[axis];
      const double high = sums.bounds().max[axis];
      if (i == 0) return 2 * std::llround(low) - 3;
      if (i == kCuts) return 2 * std::llround(high) + 3;
      return 2 * std::llround(low + (high - low) * (i - 0.1) / kCuts) + 1;
    };
    double area = 0.0;
    for (int cell = 0; cell < kCuts * kCuts * kCuts; ++cell) {
      const int at[3] = {cell % kCuts, cell / kCuts % kCuts,
                         cell / kCuts / kCuts};
      GridWindow window;
      for (int k = 0; k < 3; ++k) {
        window.min[static_cast<std::size_t>(k)] = wall(k, at[k]);
        window.max[static_cast<std::size_t>(k)] = wall(k, at[k] + 1);
      }
      area += WindowCells(sums.Within(window.Box()), window, judge, limits)
                  .SurfaceArea();
    }
    const double expected = SurfaceArea(space.mesh());
    EXPECT_NEAR(area * grid.frame.step * grid.frame.step, expected,
                1e-10 * expected);
  }
}

TEST(ConvolutionSpace, AgreesWithTheContactSpaceOnEverySegment) {
  std::mt19937_64 random(4);
  int free = 0, blocked = 0;
  for (const Pair& pair : Pairs()) {
    SCOPED_TRACE(pair.name);
    const ContactSpace space = BuildContactSpace(pair.robot, pair.obstacle);
    const FreeSpace truth({space});
    const GridPair grid = MakeGridPair(pair.robot, "a", pair.obstacle, "b");
    const ConvolutionSpace convolution(grid);
    const BoundingBox box = space.bounds();
    for (int i = 0; i < 2000; ++i) {
      const Vector3d a = testing::RandomPoint(box, &random);
      Vector3d b = testing::RandomPoint(box, &random);
      if (i % 2 == 0) b = a + 0.1 * (b - a);
      ASSERT_EQ(convolution.IsFree(a), truth.IsFree(a)) << a.transpose();
      ASSERT_EQ(convolution.IsFree(a, b), truth.IsFree(a, b))
          << a.transpose() << " to " << b.transpose();
      truth.IsFree(a, b) ? ++free : ++blocked;
      if (!truth.IsFree(a)) continue;
      const ConvolutionSpace::Nearest nearest = convolution.FindNearest(a);
      EXPECT_NEAR(nearest.distance, truth.Clearance(a), 1e-12 * box.Diagonal());
      EXPECT_NEAR((nearest.point - a).norm(), nearest.distance,
                  1e-12 * box.Diagonal());
    }
  }
  EXPECT_GT(free, 500);
  EXPECT_GT(blocked, 500);
}

}  // namespace
}  // namespace phongpd::internal
