// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/surface_geodesic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "core/projection/vertex_normals.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double Cost(const Vector3d& a, const Vector3d& b,
            const std::vector<DetourRegion>& regions) {
  double cost = (b - a).norm();
  const Vector3d middle = 0.5 * (a + b);
  for (const DetourRegion& region : regions) {
    if ((middle - region.center).norm() < region.radius) cost *= region.factor;
  }
  return cost;
}

}  // namespace

SurfaceGeodesics::SurfaceGeodesics(const TriangleMesh& mesh,
                                   const GeodesicOptions& options)
    : vertex_count_(static_cast<int>(mesh.vertices.size())),
      positions_(mesh.vertices),
      facet_normals_(FacetNormals(mesh)) {
  normals_ = VertexNormals(mesh, facet_normals_, NormalWeight::kAngle);
  AddEdgeNodes(mesh, options);
  // The same lists the other way round.
  node_first_.assign(positions_.size() + 1, 0);
  for (const int node : triangle_nodes_) ++node_first_[node + 1];
  for (std::size_t i = 1; i < node_first_.size(); ++i) {
    node_first_[i] += node_first_[i - 1];
  }
  node_triangles_.resize(triangle_nodes_.size());
  std::vector<int> next(node_first_.begin(), node_first_.end() - 1);
  for (std::size_t t = 0; t + 1 < triangle_first_.size(); ++t) {
    for (int i = triangle_first_[t]; i < triangle_first_[t + 1]; ++i) {
      node_triangles_[next[triangle_nodes_[i]]++] = static_cast<int>(t);
    }
  }
}

void SurfaceGeodesics::AddEdgeNodes(const TriangleMesh& mesh,
                                    const GeodesicOptions& options) {
  const double spacing = options.spacing * ComputeBounds(mesh).Diagonal();
  const auto neighbors = TriangleNeighbors(mesh);
  // First node and number of nodes of each triangle's edges.
  std::vector<std::array<std::pair<int, int>, 3>> edges(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int other = neighbors[t][k];
      if (other >= 0 && other < static_cast<int>(t)) continue;  // has its nodes
      const Vector3d& a = mesh.vertices[mesh.triangles[t][k]];
      const Vector3d& b = mesh.vertices[mesh.triangles[t][(k + 1) % 3]];
      const double wanted = std::ceil((b - a).norm() / spacing) - 1.0;
      const int count =
          static_cast<int>(std::clamp(wanted, 1.0, 1.0 * options.most_nodes));
      Vector3d normal = facet_normals_[t];
      if (other >= 0) normal += facet_normals_[other];
      edges[t][k] = {static_cast<int>(positions_.size()), count};
      for (int i = 1; i <= count; ++i) {
        positions_.push_back(a + i * (b - a) / (count + 1.0));
        normals_.push_back(normal.stableNormalized());
      }
      for (std::size_t j = 0; other >= 0 && j < 3; ++j) {
        if (neighbors[other][j] == static_cast<int>(t) &&
            mesh.triangles[other][j] == mesh.triangles[t][(k + 1) % 3]) {
          edges[other][j] = edges[t][k];
        }
      }
    }
  }
  triangle_first_ = {0};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangle_nodes_.push_back(mesh.triangles[t][k]);
      for (int i = 0; i < edges[t][k].second; ++i) {
        triangle_nodes_.push_back(edges[t][k].first + i);
      }
    }
    triangle_first_.push_back(static_cast<int>(triangle_nodes_.size()));
  }
}

Geodesic SurfaceGeodesics::Find(const Vector3d& from, int from_triangle,
                                const Vector3d& to, int to_triangle,
                                const std::vector<DetourRegion>& regions,
                                Vertices vertices) const {
  constexpr int kStart = -1, kNone = -2;
  const int first_node = vertices == Vertices::kAllowed ? 0 : vertex_count_;
  const std::size_t size = positions_.size();
  std::vector<double> cost(size, kInfinity);
  std::vector<int> previous(size, kNone), via(size, -1);
  std::vector<char> closed(size, 0);
  // Estimate of the whole path, node; of equal ones the smaller node.
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;

  double goal_cost = kInfinity;
  int goal_previous = kNone;
  const auto relax = [&](int node, const Vector3d& x, double reached,
                         int triangle) {
    if (triangle == to_triangle) {
      const double total = reached + Cost(x, to, regions);
      if (total < goal_cost) {
        goal_cost = total;
        goal_previous = node;
      }
    }
    for (int i = triangle_first_[triangle]; i < triangle_first_[triangle + 1];
         ++i) {
      const int next = triangle_nodes_[i];
      if (closed[next] != 0 || next < first_node) continue;
      const double total = reached + Cost(x, positions_[next], regions);
      if (!(total < cost[next])) continue;
      cost[next] = total;
      previous[next] = node;
      via[next] = triangle;
      open.push({total + (to - positions_[next]).norm(), next});
    }
  };

  Geodesic result;
  relax(kStart, from, 0.0, from_triangle);
  while (!open.empty() && open.top().first < goal_cost) {
    const int node = open.top().second;
    open.pop();
    if (closed[node] != 0) continue;
    closed[node] = 1;
    ++result.settled;
    for (int i = node_first_[node]; i < node_first_[node + 1]; ++i) {
      relax(node, positions_[node], cost[node], node_triangles_[i]);
    }
  }
  result.found = goal_previous != kNone;
  if (!result.found) return result;

  int triangle = to_triangle;
  result.points.push_back({to, facet_normals_[to_triangle], to_triangle});
  for (int node = goal_previous; node != kStart; node = previous[node]) {
    result.points.push_back({positions_[node], normals_[node], triangle});
    triangle = via[node];
  }
  result.points.push_back({from, facet_normals_[from_triangle], triangle});
  std::reverse(result.points.begin(), result.points.end());
  for (std::size_t i = 1; i < result.points.size(); ++i) {
    result.length +=
        (result.points[i].position - result.points[i - 1].position).norm();
  }
  return result;
}

}  // namespace phongpd
