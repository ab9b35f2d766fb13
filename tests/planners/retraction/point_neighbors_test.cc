// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: all points sorted by distance, then by number.
#include "planners/retraction/point_neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

namespace phongpd {
namespace {

using Eigen::Vector3d;

std::vector<int> Sorted(const MotionGraph& graph, const Vector3d& q,
                        std::size_t k) {
  std::vector<std::pair<double, int>> all;
  for (std::size_t i = 0; i < graph.points().size(); ++i) {
    all.emplace_back((graph.points()[i] - q).squaredNorm(),
                     static_cast<int>(i));
  }
  std::sort(all.begin(), all.end());
  std::vector<int> nearest;
  for (std::size_t i = 0; i < std::min(k, all.size()); ++i) {
    nearest.push_back(all[i].second);
  }
  return nearest;
}

TEST(PointNeighbors, EqualSortingByDistanceAndNumber) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> lattice(0, 7);
  std::uniform_real_distribution<double> place(0.0, 7.0);
  MotionGraph graph;
  PointNeighbors neighbors(&graph);
  EXPECT_TRUE(neighbors.Nearest(Vector3d::Zero(), 3).empty());
  EXPECT_EQ(neighbors.FindTwin(Vector3d::Zero(), 1.0), -1);
  for (int i = 0; i < 1500; ++i) {
    // Lattice points tie, and some are there more than once.
    const Vector3d p(lattice(random), lattice(random),
                     i % 3 == 0 ? place(random) : lattice(random));
    neighbors.Add(graph.AddPoint(p));
    const Vector3d q =
        i % 2 == 0 ? Vector3d(lattice(random), lattice(random), lattice(random))
                   : Vector3d(place(random), place(random), 3.5);
    for (const std::size_t k : {1u, 6u, 40u}) {
      ASSERT_EQ(neighbors.Nearest(q, k), Sorted(graph, q, k)) << i;
    }
  }
  EXPECT_EQ(neighbors.size(), 1500u);
  EXPECT_EQ(neighbors.FindTwin(graph.points()[700], 0.0),
            Sorted(graph, graph.points()[700], 1)[0]);
  EXPECT_EQ(neighbors.FindTwin({20.0, 0.0, 0.0}, 1.0), -1);
  neighbors.Clear();
  EXPECT_TRUE(neighbors.Nearest(Vector3d::Zero(), 3).empty());
}

// A sample half way between start and goal once had either as its sixth
// neighbour, by chance.
TEST(PointNeighbors, BreakTiesByNumber) {
  MotionGraph graph;
  PointNeighbors neighbors(&graph);
  for (const double x : {1.0, -1.0, 2.0, -2.0}) {
    neighbors.Add(graph.AddPoint({x, 0.0, 0.0}));
  }
  EXPECT_EQ(neighbors.Nearest(Vector3d::Zero(), 3),
            (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace phongpd
