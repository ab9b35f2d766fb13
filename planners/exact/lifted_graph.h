// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/mesh/box_tree.h"
#include "planners/exact/planning_surface.h"
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
    double length = 0.0;
    std::vector<Eigen::Vector3d> via;  // in between, from the configuration on
  };

  // Memory of a search, to be reused.
  struct Scratch {
    struct Entry {
      double bound, length;
      int node;
    };
    std::vector<double> length;
    std::vector<int> before, way;      // node and number of the way
    std::vector<std::uint32_t> round;  // in which they were set
    std::uint32_t current = 0;
    std::vector<Entry> open;
  };

  // Spacing and number of links as those of SurfaceGraph.  The surface must
  // outlive this.
  LiftedGraph(const PlanningSurface& surface, double spacing, int gap_links);

  const Counts& counts() const { return counts_; }

  // Nodes seen from q with half the clearance of both, at most `wanted` of
  // the `tried` nearest ones.
  std::vector<Stop> See(const Eigen::Vector3d& q, double clearance, int tried,
                        int wanted) const;
  // The same over the closest place of the surface, for configurations that
  // see no node nearby; empty only where rounding closed the way.
  std::vector<Stop> Descend(const Eigen::Vector3d& q, double clearance,
                            int wanted) const;

  // The shortest path from start to goal over their stops (A*); empty if none.
  std::vector<Eigen::Vector3d> Search(const Eigen::Vector3d& start,
                                      const std::vector<Stop>& starts,
                                      const Eigen::Vector3d& goal,
                                      const std::vector<Stop>& goals,
                                      Scratch* scratch) const;

 private:
  static constexpr int kLinkWays = 3;

  struct Way {
    int to;
    int via;  // −1: straight; otherwise index of two points, which lie in
              // this order from the smaller node to the larger
    double length;
  };
  struct Edge {
    int from, to, via;
    double length;
  };

  void LiftNodes();
  std::vector<Edge> JoinNodes();
  void Join(int i, int j, std::vector<Edge>* edges);
  void Store(const std::vector<Edge>& edges);

  const PlanningSurface& surface_;
  SurfaceGraph graph_;
  Counts counts_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> room_;  // clearance of a node, at most the wanted one
  std::vector<int> first_;    // of a node, into ways_
  std::vector<Way> ways_;
  std::vector<Eigen::Vector3d> via_;
  BoxTree tree_;  // of the nodes
};

}  // namespace phongpd
