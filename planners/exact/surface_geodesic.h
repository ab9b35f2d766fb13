// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

struct GeodesicOptions {
  // Distance of the extra nodes on an edge, a fraction of the diagonal of the
  // mesh; an edge gets at least one and at most `most_nodes`.
  double spacing = 0.05;
  int most_nodes = 4;
};

// A point of the surface and the direction out of the solid there: the facet's
// normal, the mean of two, or the angle-weighted vertex normal; zero where
// degenerate triangles leave none.
struct GeodesicPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  int triangle = -1;  // holds this point and the next one of the path
};

// Where a path costs `factor` ≥ 1 times its length, to make it look for
// another way.
struct DetourRegion {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;  // user's unit
  double factor = 1.0;
};

struct Geodesic {
  bool found = false;  // no: the ends lie on different surface components
  std::vector<GeodesicPoint> points;  // both ends included
  double length = 0.0;                // user's unit, without any factor
  int settled = 0;                    // nodes the search closed
};

// Short paths on a surface: A* over the vertices and a few nodes on every
// edge, joined by straight lines within triangles.  A path is on the surface,
// but up to a few percent longer than the true geodesic (of which it is an
// upper bound); whoever lifts it off the surface straightens it anyway.
class SurfaceGeodesics {
 public:
  // Closed and edge-manifold.  The graph is built once.
  explicit SurfaceGeodesics(const TriangleMesh& mesh,
                            const GeodesicOptions& options = {});

  // From a point of one triangle to a point of another.  Const, thread-safe.
  // No direction may look out of the solid from a vertex between ridges and
  // grooves; from an edge the mean normal always does.  So kAvoided finds a
  // longer path that can surely be lifted.
  enum class Vertices { kAllowed, kAvoided };
  Geodesic Find(const Eigen::Vector3d& from, int from_triangle,
                const Eigen::Vector3d& to, int to_triangle,
                const std::vector<DetourRegion>& regions = {},
                Vertices vertices = Vertices::kAllowed) const;

  // Unit facet normals, zero for degenerate triangles.
  const std::vector<Eigen::Vector3d>& facet_normals() const {
    return facet_normals_;
  }

 private:
  void AddEdgeNodes(const TriangleMesh& mesh, const GeodesicOptions& options);

  // Nodes: the vertices first, then those on edges.
  int vertex_count_ = 0;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<Eigen::Vector3d> facet_normals_;
  // Items first_[i] … first_[i + 1] − 1 of a list belong to i.
  std::vector<int> triangle_first_, triangle_nodes_;  // nodes of a triangle
  std::vector<int> node_first_, node_triangles_;      // triangles of a node
};

}  // namespace phongpd
