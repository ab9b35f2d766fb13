// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/retraction/local_projections.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/closest_on_triangle.h"
#include "core/mesh/numbers.h"

namespace phongpd {
namespace {

// Squared distances that differ by less, of themselves, are equal: two faces
// that share a foot compute it each for itself.
constexpr double kRounding = 1e-12;

using internal::At;

TrianglePoint Closest(const TriangleMesh& mesh, const Triangle& t,
                      const Eigen::Vector3d& q) {
  return ClosestOnTriangle(mesh.vertices[At(t[0])], mesh.vertices[At(t[1])],
                           mesh.vertices[At(t[2])], q);
}

Eigen::Vector3d PointAt(const TriangleMesh& mesh, const Triangle& t,
                        const Eigen::Vector3d& lambda) {
  return lambda[0] * mesh.vertices[At(t[0])] +
         lambda[1] * mesh.vertices[At(t[1])] +
         lambda[2] * mesh.vertices[At(t[2])];
}

}  // namespace

void FindLocalProjections(const TriangleMesh& mesh,
                          const std::vector<std::array<int, 3>>& neighbors,
                          const Eigen::Vector3d& q, double bound,
                          LocalProjectionScratch* scratch,
                          std::vector<LocalProjection>* found) {
  found->clear();
  std::vector<double>& of_triangle = scratch->of_triangle;
  std::vector<double>& of_vertex = scratch->of_vertex;
  of_triangle.resize(mesh.triangles.size());
  of_vertex.assign(mesh.vertices.size(),
                   std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    of_triangle[i] = Closest(mesh, mesh.triangles[i], q).squared_distance;
    for (const int v : mesh.triangles[i]) {
      of_vertex[At(v)] = std::min(of_vertex[At(v)], of_triangle[i]);
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const double here = of_triangle[i];
    if (!(here <= bound * bound)) continue;
    const Triangle& t = mesh.triangles[i];
    const TrianglePoint closest = Closest(mesh, t, q);
    const auto is_least = [here](double other) {
      return other >= here * (1.0 - kRounding);
    };
    bool is_local = true;
    const auto zeros = (closest.lambda.array() == 0.0).count();
    for (int k = 0; k < 3 && zeros == 1; ++k) {
      if (closest.lambda[k] != 0.0) continue;
      const int other = neighbors[i][At((k + 1) % 3)];
      is_local = other >= 0 && is_least(of_triangle[At(other)]);
    }
    for (int k = 0; k < 3 && zeros == 2; ++k) {
      if (closest.lambda[k] == 0.0) continue;
      is_local = is_least(of_vertex[At(t[At(k)])]);
    }
    if (!is_local) continue;
    const Eigen::Vector3d point = PointAt(mesh, t, closest.lambda);
    found->push_back({static_cast<int>(i), point, std::sqrt(here)});
  }
  std::sort(found->begin(), found->end(), [](const auto& a, const auto& b) {
    return a.distance != b.distance ? a.distance < b.distance
                                    : a.triangle < b.triangle;
  });
  // The faces that share a foot list it each.
  const auto is_same = [bound](const auto& a, const auto& b) {
    return (a.point - b.point).norm() <=
           1e-6 * std::min(bound, std::max(a.distance, b.distance));
  };
  std::size_t kept = 0;
  for (const LocalProjection& p : *found) {
    const bool is_known =
        std::any_of(found->begin(), found->begin() + static_cast<long>(kept),
                    [&](const auto& other) { return is_same(p, other); });
    if (!is_known) (*found)[kept++] = p;
  }
  found->resize(kept);
}

}  // namespace phongpd
