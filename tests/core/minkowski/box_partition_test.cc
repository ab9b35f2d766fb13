// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: volumes and areas in whole numbers, and the whole convolution.
#include "core/minkowski/windows/box_partition.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "core/minkowski/operands/grid_pair.h"
#include "problems/shapes/shapes.h"
#include "tests/support/facet_corners.h"
#include "tests/support/solid_tools.h"

namespace phongpd::internal {
namespace {

using testing::AllCorners;
using testing::Cube;
using testing::FacetCorners;

struct Partition {
  Partition(const TriangleMesh& robot, const TriangleMesh& obstacle,
            std::size_t most)
      : grid(MakeGridPair(robot, "a", obstacle, "b")),
        sums(grid.obstacle, grid.reflected_robot),
        all(ReducedConvolution(grid.obstacle, grid.reflected_robot)),
        whole(GridWindow::Around(
            sums.bounds().Center(),
            0.6 * (sums.bounds().max - sums.bounds().min).maxCoeff())),
        boxes(sums, whole, most),
        leaves(boxes.LeavesIn(whole.Box())) {}

  GridPair grid;
  FeatureSums sums;
  Convolution all;
  GridWindow whole;
  BoxPartition boxes;
  std::vector<int> leaves;
};

template <typename Visit>
void ForEachPartition(const Visit& visit) {
  const auto run = [&](const char* name, const TriangleMesh& robot,
                       const TriangleMesh& obstacle, std::size_t most) {
    SCOPED_TRACE(name);
    Partition partition(robot, obstacle, most);
    visit(&partition);
  };
  run("star and knot", MakeStar(0.3, 0.7), MakeKnot(0.5, 0.2, 32, 6), 200);
  run("ball and cone", MakeIcoBall(0.5, 1), MakeCone(0.8, 1.6, 12), 40);
  run("cube and hollow shell", Cube(1), MakeVessel(4, 3, 0), 10);
  run("turned star and vessel", MakeStar(0.3, 0.7),
      Rotated(MakeVessel(3.6, 3, 0.6), GenericRotation()), 30);
}

Int128 Volume(const GridWindow& w) {
  Int128 volume = 1;
  for (int k = 0; k < 3; ++k) volume *= w.max[k] - w.min[k];
  return volume;
}

TEST(BoxPartition, FillsItsBoxWithOddWalls) {
  ForEachPartition([](Partition* p) {
    ASSERT_GT(p->leaves.size(), 4U);
    Int128 sum = 0;
    for (const int leaf : p->leaves) {
      const GridWindow& window = p->boxes.window(leaf);
      for (int k = 0; k < 3; ++k) {
        ASSERT_LT(window.min[k], window.max[k]);
        ASSERT_TRUE(window.min[k] & window.max[k] & 1);
        ASSERT_GE(window.min[k], p->whole.min[k]);
        ASSERT_LE(window.max[k], p->whole.max[k]);
      }
      sum += Volume(window);
      // Nobody else is there: with the sum, no gap either.
      const Eigen::Vector3d middle = window.Box().Center();
      EXPECT_EQ(p->boxes.LeavesIn({middle, middle}), std::vector<int>{leaf});
    }
    EXPECT_TRUE(sum == Volume(p->whole));
  });
}

TEST(BoxPartition, TellsTheFacetsOfEachBoxOnce) {
  ForEachPartition([](Partition* p) {
    const std::set<FacetCorners> all = AllCorners(p->all);
    std::set<FacetCorners> found;
    for (const int leaf : p->leaves) {
      const BoundingBox box = p->boxes.window(leaf).Box();
      const std::set<FacetCorners> in_box =
          AllCorners(p->boxes.Take(leaf).convolution);
      for (const FacetCorners& t : all) {
        EXPECT_TRUE(in_box.count(t) != 0 || !testing::IsSeenIn(t, box));
      }
      for (const FacetCorners& t : in_box) EXPECT_EQ(all.count(t), 1U);
      EXPECT_THROW(p->boxes.Take(leaf), std::logic_error);
      // From the sums of features: by another filter.
      const std::set<FacetCorners> again =
          AllCorners(p->sums.Within(box).convolution);
      for (const FacetCorners& t : in_box) {
        EXPECT_TRUE(again.count(t) != 0 || !testing::IsSeenIn(t, box));
      }
      found.insert(in_box.begin(), in_box.end());
    }
    EXPECT_EQ(found, all);
  });
}

TEST(BoxPartition, CutsWallsByWhatIsBeyondAndAlikeFromBothSides) {
  using Key = std::tuple<int, int, GridPoint, GridPoint>;
  ForEachPartition([](Partition* p) {
    std::map<Key, int> across;  // from, to and place: the axis
    for (const int leaf : p->leaves) {
      const GridWindow& window = p->boxes.window(leaf);
      std::map<std::pair<int, bool>, Int128> areas;
      for (const WallPatch& patch : p->boxes.Walls(leaf)) {
        const int u = (patch.axis + 1) % 3, v = (patch.axis + 2) % 3;
        ASSERT_LT(patch.min[u], patch.max[u]);
        ASSERT_LT(patch.min[v], patch.max[v]);
        const std::int64_t at =
            (patch.is_high ? window.max : window.min)[patch.axis];
        ASSERT_EQ(patch.min[patch.axis], at);
        ASSERT_EQ(patch.max[patch.axis], at);
        areas[{patch.axis, patch.is_high}] +=
            Int128(patch.max[u] - patch.min[u]) * (patch.max[v] - patch.min[v]);
        const bool is_border =
            at == (patch.is_high ? p->whole.max : p->whole.min)[patch.axis];
        ASSERT_EQ(patch.beyond < 0, is_border);
        if (is_border) continue;
        const bool is_new =
            across
                .emplace(Key{leaf, patch.beyond, patch.min, patch.max},
                         patch.is_high ? patch.axis : -1 - patch.axis)
                .second;
        EXPECT_TRUE(is_new);
      }
      ASSERT_EQ(areas.size(), 6U);
      for (const auto& [wall, area] : areas) {
        GridPoint size = window.max - window.min;
        size[wall.first] = 1;
        EXPECT_TRUE(area == Volume({GridPoint{}, size}));
      }
    }
    for (const auto& [key, axis] : across) {
      const auto& [from, to, min, max] = key;
      const auto back = across.find(Key{to, from, min, max});
      ASSERT_NE(back, across.end());
      EXPECT_EQ(back->second, -1 - axis);
    }
  });
}

}  // namespace
}  // namespace phongpd::internal
