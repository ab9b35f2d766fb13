// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the whole convolution and the whole contact space.
#include "core/minkowski/windows/window_cells.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "core/contact/contact_space.h"
#include "core/minkowski/operands/grid_pair.h"
#include "problems/shapes/shapes.h"
#include "tests/support/facet_corners.h"
#include "tests/support/named_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using testing::AllCorners;
using testing::FacetCorners;
using testing::NamedPair;
using testing::SmallPairs;

TEST(FeatureSums, TellTheWholeConvolutionInItsBox) {
  for (const NamedPair& pair : SmallPairs()) {
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
  for (const NamedPair& pair : SmallPairs()) {
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

}  // namespace
}  // namespace phongpd::internal
