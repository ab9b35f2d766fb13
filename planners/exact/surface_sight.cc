// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/surface_sight.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/bvh/exact_sign.h"
#include "core/mesh/unit_normal.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

struct Facing {
  int triangle;
  double slope;  // cosine between its normal and the way to q
};

SurfaceSite SiteAt(const Vector3d& q, const Vector3d& p, int triangle) {
  SurfaceSite site;
  site.point = p;
  site.triangle = triangle;
  // At edges only the way back to q is free for sure.
  site.direction = Unit(q - p);
  return site;
}

bool IsFacing(const TriangleMesh& mesh, int triangle, const Vector3d& q) {
  const Triangle& t = mesh.triangles[triangle];
  return Orient3d(mesh.vertices[t[0]].data(), mesh.vertices[t[1]].data(),
                  mesh.vertices[t[2]].data(), q.data()) > 0;
}

// Barycentric coordinates of places in a triangle which lie in different
// directions from each of its corners: the middle, and two near every side, so
// that what hides one sector of a corner leaves others.
constexpr double kPlaces[][3] = {
    {0.4, 0.3, 0.3},   {0.05, 0.15, 0.8}, {0.05, 0.8, 0.15}, {0.15, 0.05, 0.8},
    {0.8, 0.05, 0.15}, {0.15, 0.8, 0.05}, {0.8, 0.15, 0.05}};

// In the triangle, near its corner p, where q sees it.
std::optional<SurfaceSite> MoveInto(const Vector3d& q, const Vector3d& p,
                                    int triangle, const TriangleMesh& mesh,
                                    const TriangleBvh& segments) {
  const Triangle& t = mesh.triangles[triangle];
  for (double step = 0.25; step > 1e-6; step *= 0.125) {
    for (const auto& weights : kPlaces) {
      Vector3d target = (1.0 - step) * p;
      for (std::size_t k = 0; k < 3; ++k) {
        target += step * weights[k] * mesh.vertices[t[k]];
      }
      const Vector3d way = 1.0625 * (target - q);  // through the triangle
      const TriangleBvh::Hit hit = segments.FirstHit(q, q + way);
      if (hit.triangle == triangle) {
        return SiteAt(q, q + hit.fraction * way, triangle);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<SurfaceSite> SiteSeenFrom(const Vector3d& q, const Vector3d& p,
                                        int triangle, const TriangleMesh& mesh,
                                        const TriangleBvh& segments,
                                        double rounding) {
  // As far as p may be from where the way ends.
  const double near =
      std::max(rounding, std::ldexp(q.cwiseAbs().maxCoeff(), -46));
  const Vector3d back = Unit(q - p);
  std::vector<Facing> facing;
  bool is_corner = false;
  int touched = 0;
  const auto add = [&](int t) {
    const Triangle& corners = mesh.triangles[t];
    ++touched;
    is_corner |= std::any_of(corners.begin(), corners.end(), [&](int v) {
      return (mesh.vertices[v] - p).norm() <= near;
    });
    if (IsFacing(mesh, t, q)) {
      facing.push_back({t, back.dot(UnitNormal(mesh, corners))});
    }
  };
  add(triangle);
  segments.ForEachDoubt(p, p, near, [&](int t, double distance) {
    if (distance <= near && t != triangle) add(t);
  });
  std::stable_sort(
      facing.begin(), facing.end(),
      [](const Facing& a, const Facing& b) { return a.slope > b.slope; });
  // An edge of more triangles has several free sectors.
  const bool is_plain = !is_corner && touched <= 2;
  for (const Facing& one : facing) {
    if (is_plain) return SiteAt(q, p, one.triangle);
    const auto moved = MoveInto(q, p, one.triangle, mesh, segments);
    if (moved) return moved;
  }
  return std::nullopt;
}

}  // namespace phongpd
