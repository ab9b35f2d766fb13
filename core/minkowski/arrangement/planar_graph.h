// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/minkowski/operands/exact_points.h"

namespace phongpd::internal {

class BuildLimits;

// Number of facets to the left of an edge, per orientation class.
using Coverage = std::array<int, 2>;

// The arrangement of segments in one plane as a planar graph with faces.
// Everything is decided exactly; see exact_points.h.
class PlanarGraph {
 public:
  // Hardly ever more than a few: none is allocated for them.
  using Few = boost::container::small_vector<int, 4>;

  explicit PlanarGraph(const GridPlane& plane);

  // Adds a vertex (with distinct points only) and returns its index.
  int AddVertex(const LocatedPoint& point);
  // Adds a segment between two vertices on the line where `cutter` meets the
  // plane; `net` counts the facets it bounds, on the left of from → to seen
  // along the plane's normal.
  void AddSegment(int from, int to, const GridPlane& cutter,
                  const Coverage& net);
  // The plane through the segment a–b of grid points, across this plane.
  GridPlane CutterAlong(const GridPoint& a, const GridPoint& b) const;

  // Crosses all segments, splits them, forms faces and their coverage.  Throws
  // BuildRefusal when `limits`, if there are any, are passed.
  void Build(const BuildLimits* limits = nullptr);

  // After Build: half-edge 2e runs along edge e, 2e + 1 back.  Faces lie on
  // the left of their half-edges, seen with the plane's normal towards the
  // eye, or on the right where IsMirrored.
  struct Face {
    Coverage coverage{};
    // One half-edge of every border loop.
    boost::container::small_vector<int, 2> loops;
  };
  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<LocatedPoint>& vertices() const { return vertices_; }
  int From(int half_edge) const {
    return edges_[half_edge / 2].end[half_edge % 2];
  }
  int Next(int half_edge) const { return next_[half_edge]; }
  // The graph is seen against the plane's normal.
  bool IsMirrored() const { return mirrored_; }

 private:
  struct Segment {
    int from, to;
    GridPlane cutter;
    RoundedPlane rounded;  // the cutter
    Coverage net;
    Few inner;  // vertices strictly between the ends
    Eigen::Vector2d low, high;
    // The direction from → to is turn · (plane normal × cutter normal).
    int turn = 1;
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // unit
  };
  struct Edge {
    std::array<int, 2> end;
    Coverage net;  // along end[0] → end[1]
    int segment;
    bool along;  // end[0] → end[1] runs like its segment
  };
  // A component of the graph: its lexicographically smallest vertex and the
  // half-edge whose left is outside the component.
  struct Component {
    int corner, outer;
  };

  int Side(const Segment& segment, int vertex) const;
  int Compare(int v, int w, int axis) const {
    return CompareCoordinate(vertices_[v], vertices_[w], axis);
  }
  // The coordinate in which the segment varies most.
  int Axis(const Segment& s) const {
    return std::abs(s.direction[0]) >= std::abs(s.direction[1]) ? u_ : v_;
  }
  bool StrictlyBetween(int vertex, const Segment& segment) const;
  int AddCrossing(const Segment& s, const Segment& t);
  void CrossAll(const BuildLimits* limits);
  void Cross(Segment* s, Segment* t);
  void OrientSegments();
  void SplitSegments();
  std::array<Wide, 2> ExactDirection(int half_edge) const;
  Eigen::Vector2d Direction(int half_edge) const;
  void SortOutgoing(Few* half_edges) const;
  void LinkLoops();
  // Does every half-edge go on where it ends, and none twice?
  bool HasLoops() const;
  std::vector<Component> FindComponents() const;
  int HalfEdgeLeftOf(const Component& component,
                     const std::vector<int>& component_of,
                     const BoxTree& tree) const;
  BoxTree EdgeTree() const;
  int RightOfEdge(int edge, int vertex) const;
  bool IsCloser(int e, int f, int vertex) const;
  void FormFaces();
  void SpreadCoverage();
  Eigen::Vector2d Flat(int vertex) const {
    const Eigen::Vector3d& p = vertices_[vertex].approximate;
    return {p[u_], p[v_]};
  }

  GridPlane plane_;
  int dropped_, u_, v_;
  bool mirrored_;  // the projection looks against the normal
  std::vector<LocatedPoint> vertices_;
  std::unordered_multimap<GridPoint, int, GridPointHash> cells_;
  std::vector<Segment> segments_;
  std::vector<Edge> edges_;
  std::vector<Few> outgoing_;  // per vertex, counter-clockwise
  std::vector<int> next_;
  std::vector<int> face_of_;  // per half-edge
  std::vector<Face> faces_;   // 0 is the unbounded one
};

}  // namespace phongpd::internal
