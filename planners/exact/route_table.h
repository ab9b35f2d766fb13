// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace phongpd {

// Shortest routes on one undirected graph, many times.
//
// A* with landmarks (A. V. Goldberg, C. Harrelson, *Computing the shortest
// path: A* search meets graph theory*, SODA 2005): with the distances d_k of
// every node to kLandmarks nodes of its connected part, far from each other,
// |d_k(v) − d_k(g)| ≤ d(v, g) bounds what is left to go.  Routes are shortest
// up to rounding.
class RouteTable {
 public:
  struct Edge {
    int from, to;
    double length;  // ≥ 0, finite
  };
  // A node at which routes may begin or end, at a price.
  struct Stop {
    int node;
    double length;
  };
  // edges[i], an index, joins nodes[i] and nodes[i + 1]; start and goal are
  // indices of stops.  No nodes: there is no route.
  struct Route {
    int start = -1, goal = -1;
    double length = 0.0;
    std::vector<int> nodes, edges;
  };
  // Memory of a search, to be reused.
  struct Scratch {
    struct Entry {
      double bound, length;
      int node;
    };
    std::vector<double> length;
    std::vector<int> before, edge;
    std::vector<std::uint32_t> round;  // in which they were set
    std::uint32_t current = 0;
    std::vector<Entry> open;
  };

  RouteTable() = default;
  RouteTable(int nodes, const std::vector<Edge>& edges);

  // Thread-safe with one scratch per thread, which may be new.
  Route Search(const std::vector<Stop>& starts, const std::vector<Stop>& goals,
               Scratch* scratch) const;

 private:
  static constexpr std::size_t kLandmarks = 16;
  using Distances = std::array<double, kLandmarks>;
  struct Arc {
    int to, edge;
    double length;
  };

  void MeasureLandmarks();
  void MeasureFrom(int node, std::size_t landmark, Scratch* scratch);

  std::vector<int> first_;  // of a node, into arcs_
  std::vector<Arc> arcs_;
  std::vector<Distances> distances_;  // to the landmarks of its part
};

}  // namespace phongpd
