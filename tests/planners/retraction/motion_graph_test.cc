// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/retraction/motion_graph.h"

#include <gtest/gtest.h>

#include <random>

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

TEST(MotionGraph, TakesTheShorterOfTwoWays) {
  MotionGraph graph;
  const Vector3d a(0, 0, 0), b(1, 1, 0), over(0, 3, 0), under(1, 0, 0);
  const int from = graph.AddPoint(a), to = graph.AddPoint(b);
  EXPECT_FALSE(graph.AreConnected(from, to));
  EXPECT_TRUE(graph.ShortestPath(from, to).empty());
  EXPECT_EQ(graph.AddPath(from, {a, over, b}, to), to);
  EXPECT_EQ(graph.ShortestPath(from, to), (Path{a, over, b}));
  const int middle = graph.AddPath(to, {b, under});
  EXPECT_EQ(middle, 3);
  graph.AddPath(middle, {under, a}, from);
  EXPECT_EQ(graph.ShortestPath(from, to), (Path{a, under, b}));
  EXPECT_EQ(graph.ShortestPath(to, from), (Path{b, under, a}));
  EXPECT_EQ(graph.ShortestPath(from, from), (Path{a}));
  EXPECT_EQ(graph.points().size(), 4u);
  EXPECT_EQ(graph.edges().size(), 4u);
  graph.Clear();
  EXPECT_TRUE(graph.points().empty());
  EXPECT_TRUE(graph.edges().empty());
}

TEST(MotionGraph, JoinsPointsThatCoincide) {
  MotionGraph graph;
  const Vector3d q(1, 2, 3);
  const int a = graph.AddPoint(q), b = graph.AddPoint(q);
  EXPECT_EQ(graph.AddPath(a, {q}, b), b);
  EXPECT_EQ(graph.ShortestPath(a, b), (Path{q, q}));
  EXPECT_EQ(graph.AddPath(a, {q}, a), a);
  EXPECT_EQ(graph.points().size(), 2u);
  EXPECT_EQ(graph.edges().size(), 1u);
}

// Components by flooding the edges.
TEST(MotionGraph, KnowsItsComponents) {
  std::mt19937_64 random(2);
  MotionGraph graph;
  constexpr int kPoints = 200;
  for (int i = 0; i < kPoints; ++i) graph.AddPoint(Vector3d(i, 0, 0));
  for (int k = 0; k < 120; ++k) {
    const int i = static_cast<int>(random() % kPoints);
    const int j = static_cast<int>(random() % kPoints);
    graph.AddPath(i, {Vector3d(i, 0, 0), Vector3d(j, 0, 0)}, j);
  }
  std::vector<int> label(kPoints);
  for (int i = 0; i < kPoints; ++i) label[static_cast<std::size_t>(i)] = i;
  for (int sweep = 0; sweep < kPoints; ++sweep) {
    for (const auto& [i, j] : graph.edges()) {
      int& a = label[static_cast<std::size_t>(i)];
      int& b = label[static_cast<std::size_t>(j)];
      a = b = std::min(a, b);
    }
  }
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      ASSERT_EQ(graph.AreConnected(i, j),
                label[static_cast<std::size_t>(i)] ==
                    label[static_cast<std::size_t>(j)]);
    }
  }
}

}  // namespace
}  // namespace phongpd
