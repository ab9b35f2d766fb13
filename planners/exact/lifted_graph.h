// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/box_tree.h"
#include "planners/exact/planning_surface.h"
#include "planners/exact/route_table.h"
#include "planners/exact/surface_graph.h"

namespace phongpd {

// A SurfaceGraph lifted off the surface once and for all.
//
// Node i is site i moved by min(the cell's wanted clearance, ½ · gap).  A way
// between two nodes is the straight segment where that is free and keeps half
// of what its ends keep; elsewhere both ends are lowered for this way alone
// until the segment between them is free (LiftRoute), and the way runs node →
// lowered → lowered → node.  Every segment of every way is free of contact by
// an exact test.  Where rounding folded the surface a way cannot be lifted
// and is left out.
//
// The price of a way is its length, up to twice that where it is narrower than
// wanted.
//
// Points of edges are joined across triangles, each end of a link to the
// kLinkWays nearest points of its triangle's edges: links do not multiply
// where many end on one large triangle.
class LiftedGraph {
 public:
  struct Counts {
    int nodes = 0, ways = 0;
    int lowered = 0;  // ways that are not straight
    int left_out = 0;
  };

  // How a configuration reaches a node.
  struct Stop {
    int node = -1;
    double price = 0.0;
    std::vector<Eigen::Vector3d> via;  // in between, from the configuration on
  };

  // Spacing and number of links as those of SurfaceGraph.  The surface must
  // outlive this.
  LiftedGraph(const PlanningSurface& surface, double spacing, int gap_links);

  const Counts& counts() const { return counts_; }

  // Adds nodes that q sees with half the clearance of both, at most `wanted`
  // of the `tried` ones nearest to `around`, which are q's nearest nodes or
  // those near a place that q sees.
  void See(const Eigen::Vector3d& q, const Eigen::Vector3d& around,
           double clearance, int tried, int wanted,
           std::vector<Stop>* stops) const;
  // Nodes reached over the closest place of the surface, for configurations
  // that see no node nearby; empty only where rounding closed the way.
  std::vector<Stop> Descend(const Eigen::Vector3d& q, double clearance,
                            int wanted) const;

  // The cheapest path from start to goal over their stops; empty if none.
  std::vector<Eigen::Vector3d> Search(const Eigen::Vector3d& start,
                                      const std::vector<Stop>& starts,
                                      const Eigen::Vector3d& goal,
                                      const std::vector<Stop>& goals,
                                      RouteTable::Scratch* scratch) const;

 private:
  static constexpr int kLinkWays = 3;

  using Edges = std::vector<RouteTable::Edge>;

  void LiftNodes();
  Edges JoinNodes();
  void Join(int i, int j, Edges* edges);

  const PlanningSurface& surface_;
  SurfaceGraph graph_;
  Counts counts_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> room_;   // clearance of a node, at most the wanted one
  std::vector<double> share_;  // of the wanted one
  RouteTable routes_;
  // Of an edge −1: straight; otherwise index of two points, which lie in this
  // order from the smaller node to the larger.
  std::vector<int> via_of_;
  std::vector<Eigen::Vector3d> via_;
  BoxTree tree_;  // of the nodes
};

}  // namespace phongpd
