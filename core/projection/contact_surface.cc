// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/contact_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/unit_normal.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

// Counts half-edges without exactly one opposite.
std::size_t CountBadEdges(const TriangleMesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  std::size_t bad = 0;
  for (const auto& [a, b] : edges) {
    const auto same =
        std::equal_range(edges.begin(), edges.end(), std::make_pair(a, b));
    const auto opposite =
        std::equal_range(edges.begin(), edges.end(), std::make_pair(b, a));
    if (same.second - same.first != 1 ||
        opposite.second - opposite.first != 1) {
      ++bad;
    }
  }
  return bad;
}

}  // namespace

void CheckContactMesh(const TriangleMesh& mesh) {
  const std::string name = "contact mesh: ";
  if (mesh.triangles.empty()) throw InputError(name + "no triangle");
  const int size = static_cast<int>(mesh.vertices.size());
  std::size_t bad_indices = 0, bad_vertices = 0;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      const bool valid = v >= 0 && v < size;
      bad_indices += !valid;
      bad_vertices += valid && !IsFinite(mesh.vertices[v]);
    }
  }
  if (bad_indices > 0) {
    throw InputError(name + std::to_string(bad_indices) +
                     " vertex indices out of range");
  }
  if (bad_vertices > 0) {
    throw InputError(name + std::to_string(bad_vertices) +
                     " corners with non-finite coordinates");
  }
  const double diagonal = ComputeBounds(mesh).Diagonal();
  if (!(diagonal >= 1e-150 && diagonal <= 1e150)) {
    throw InputError(name +
                     "diagonal of the bounding box must be between "
                     "1e-150 and 1e150, found " +
                     std::to_string(diagonal));
  }
  const std::size_t bad_edges = CountBadEdges(mesh);
  if (bad_edges > 0) {
    throw InputError(name + "must be closed and edge-manifold, found " +
                     std::to_string(bad_edges) +
                     " half-edges without exactly one opposite");
  }
}

ContactSurface::ContactSurface(const TriangleMesh& mesh) : mesh_(mesh) {
  CheckContactMesh(mesh_);
  inside_ = InsideTest(mesh_);
  tree_ = SurfaceTree(mesh_);
  facet_normals_.reserve(mesh_.triangles.size());
  for (const Triangle& t : mesh_.triangles) {
    const Vector3d e1 =
        (mesh_.vertices[t[1]] - mesh_.vertices[t[0]]) * tree_.scale();
    const Vector3d e2 =
        (mesh_.vertices[t[2]] - mesh_.vertices[t[0]]) * tree_.scale();
    const Vector3d e3 = e2 - e1;
    // The two shortest edges give the best-conditioned normal.
    const double l1 = e1.squaredNorm(), l2 = e2.squaredNorm(),
                 l3 = e3.squaredNorm();
    const Vector3d n = l1 >= l2 && l1 >= l3   ? e3.cross(Vector3d(-e2))
                       : l2 >= l1 && l2 >= l3 ? e1.cross(e3)
                                              : e1.cross(e2);
    facet_normals_.push_back(Unit(n));
  }
}

Vector3d ContactSurface::Point(int triangle, const Vector3d& lambda) const {
  const Triangle& t = mesh_.triangles[triangle];
  const Vector3d& q0 = mesh_.vertices[t[0]];
  if (lambda[1] == 1.0) return mesh_.vertices[t[1]];
  if (lambda[2] == 1.0) return mesh_.vertices[t[2]];
  return q0 + lambda[1] * (mesh_.vertices[t[1]] - q0) +
         lambda[2] * (mesh_.vertices[t[2]] - q0);
}

PenetrationResult ContactSurface::Answer(const Vector3d& q_o,
                                         Location location) const noexcept {
  const SurfaceTree::Closest closest = tree_.FindClosest(q_o);
  PenetrationResult result;
  result.status = QueryStatus::kOk;
  result.inside = location == Location::kInside;
  result.triangle = closest.triangle;
  result.contact = Point(closest.triangle, closest.lambda);
  // At the end of doubles a distance may overflow; no result is infinite.
  const double distance = location == Location::kOnSurface
                              ? 0.0
                              : std::clamp(closest.distance, LeastDistance(),
                                           std::numeric_limits<double>::max());
  result.signed_distance = result.inside ? -distance : distance;
  const Vector3d& normal = facet_normals_[closest.triangle];
  const bool in_facet = closest.lambda.minCoeff() > 0.0;
  const bool at_contact = distance * tree_.scale() <= 1e-12;
  Vector3d direction = result.inside ? Vector3d(result.contact - q_o)
                                     : Vector3d(q_o - result.contact);
  // The norm may be beyond all doubles where no coordinate is.
  if (direction.cwiseAbs().maxCoeff() > 1e300) direction *= 0x1p-10;
  direction = Unit(direction);
  if ((in_facet || at_contact) && normal.squaredNorm() > 0.0) {
    // A foot inside the facet, but not the facet's side q_o is on: rounding
    // in a sliver; the difference is the better answer there.
    if (at_contact || normal.dot(direction) > 0.9) direction = normal;
  }
  result.direction = direction;
  result.gradient = direction;
  return result;
}

}  // namespace phongpd
