// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: all shortest distances by Floyd and Warshall.
#include "planners/exact/route_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace phongpd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct RandomGraph {
  int nodes = 0;
  std::vector<RouteTable::Edge> edges;
  std::vector<std::vector<double>> distance;
};

// Sparse, so that most have several parts; with parallel edges, loops and
// edges without length.
RandomGraph MakeGraph(std::mt19937_64* random) {
  RandomGraph graph;
  graph.nodes = 1 + static_cast<int>((*random)() % 40);
  const std::size_t n = static_cast<std::size_t>(graph.nodes);
  graph.distance.assign(n, std::vector<double>(n, kInfinity));
  for (std::size_t i = 0; i < n; ++i) graph.distance[i][i] = 0.0;
  const std::size_t edges = (*random)() % (3 * n);
  for (std::size_t e = 0; e < edges; ++e) {
    const std::size_t i = (*random)() % n, j = (*random)() % n;
    const double length = static_cast<double>((*random)() % 1000) / 128.0;
    graph.edges.push_back({static_cast<int>(i), static_cast<int>(j), length});
    double& known = graph.distance[i][j];
    known = graph.distance[j][i] = std::min(known, length);
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        double& known = graph.distance[i][j];
        known = std::min(known, graph.distance[i][k] + graph.distance[k][j]);
      }
    }
  }
  return graph;
}

std::vector<RouteTable::Stop> MakeStops(int nodes, std::mt19937_64* random) {
  std::vector<RouteTable::Stop> stops;
  for (std::size_t i = (*random)() % 5; i > 0; --i) {
    stops.push_back(
        {static_cast<int>((*random)() % static_cast<std::size_t>(nodes)),
         static_cast<double>((*random)() % 500) / 64.0});
  }
  return stops;
}

// The length of a route along its edges; fails where they are not joined.
double LengthOf(const RouteTable::Route& route, const RandomGraph& graph,
                const std::vector<RouteTable::Stop>& starts,
                const std::vector<RouteTable::Stop>& goals) {
  const RouteTable::Stop& start = starts.at(route.start);
  const RouteTable::Stop& goal = goals.at(route.goal);
  EXPECT_EQ(route.nodes.front(), start.node);
  EXPECT_EQ(route.nodes.back(), goal.node);
  EXPECT_EQ(route.nodes.size(), route.edges.size() + 1);
  double length = start.length + goal.length;
  for (std::size_t k = 0; k < route.edges.size(); ++k) {
    const RouteTable::Edge& edge = graph.edges.at(route.edges[k]);
    EXPECT_EQ(std::minmax(route.nodes[k], route.nodes[k + 1]),
              std::minmax(edge.from, edge.to));
    length += edge.length;
  }
  return length;
}

TEST(RouteTable, FindsShortestRoutes) {
  std::mt19937_64 random(1);
  int found = 0, none = 0;
  RouteTable::Scratch scratch;
  for (int i = 0; i < 400; ++i) {
    const RandomGraph graph = MakeGraph(&random);
    const RouteTable table(graph.nodes, graph.edges);
    for (int query = 0; query < 20; ++query) {
      const auto starts = MakeStops(graph.nodes, &random);
      const auto goals = MakeStops(graph.nodes, &random);
      double shortest = kInfinity;
      for (const RouteTable::Stop& a : starts) {
        for (const RouteTable::Stop& b : goals) {
          shortest = std::min(
              shortest, a.length + graph.distance[a.node][b.node] + b.length);
        }
      }
      const RouteTable::Route route = table.Search(starts, goals, &scratch);
      ASSERT_EQ(route.nodes.empty(), shortest == kInfinity);
      if (route.nodes.empty()) {
        ++none;
        continue;
      }
      ++found;
      EXPECT_NEAR(route.length, shortest, 1e-12 * (1.0 + shortest));
      EXPECT_NEAR(LengthOf(route, graph, starts, goals), shortest,
                  1e-12 * (1.0 + shortest));
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(none, 1000);
}

TEST(RouteTable, StaysOnOneNode) {
  const RouteTable table(2, {});
  RouteTable::Scratch scratch;
  const RouteTable::Route route =
      table.Search({{0, 1.0}, {1, 2.0}}, {{1, 0.5}}, &scratch);
  EXPECT_EQ(route.nodes, std::vector<int>{1});
  EXPECT_EQ(route.start, 1);
  EXPECT_EQ(route.length, 2.5);
  EXPECT_TRUE(table.Search({{0, 0.0}}, {{1, 0.0}}, &scratch).nodes.empty());
  EXPECT_TRUE(table.Search({}, {{1, 0.0}}, &scratch).nodes.empty());
}

// The count that tells searches apart runs over.
TEST(RouteTable, KeepsRoundsOfAScratchApart) {
  const RouteTable table(3, {{0, 1, 1.0}, {1, 2, 1.0}});
  RouteTable::Scratch scratch;
  for (const std::uint32_t current :
       {0u, std::numeric_limits<std::uint32_t>::max() - 1}) {
    scratch.current = current;
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(table.Search({{0, 0.0}}, {{2, 0.0}}, &scratch).nodes,
                (std::vector<int>{0, 1, 2}));
    }
  }
}

}  // namespace
}  // namespace phongpd
