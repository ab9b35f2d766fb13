// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/surface_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/closest_on_triangle.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

}  // namespace

SurfaceWalk::SurfaceWalk(const ContactSpace& space)
    : space_(space),
      bvh_(&space_.bvh()),
      corners_(CornersOf(space_.mesh())),
      neighbors_(TriangleNeighbors(space_.mesh())),
      component_(corners_.size(), -1) {
  for (TriangleCorners& t : corners_) t = bvh_->ToFrame(t);
  int count = 0;
  std::vector<int> open;
  for (std::size_t first = 0; first < corners_.size(); ++first) {
    if (component_[first] >= 0) continue;
    component_[first] = count;
    open.push_back(static_cast<int>(first));
    while (!open.empty()) {
      const int triangle = open.back();
      open.pop_back();
      for (const int next : neighbors_[triangle]) {
        if (component_[next] >= 0) continue;
        component_[next] = count;
        open.push_back(next);
      }
    }
    ++count;
  }
}

Vector3d SurfaceWalk::At(const MeshPoint& p) const {
  const TriangleCorners& t = corners_[p.triangle];
  return t[0] + p.lambda[1] * (t[1] - t[0]) + p.lambda[2] * (t[2] - t[0]);
}

MeshPoint SurfaceWalk::SeenFrom(int triangle, const MeshPoint& p) const {
  if (triangle == p.triangle) return p;
  const Triangle& from = space_.mesh().triangles[p.triangle];
  const Triangle& to = space_.mesh().triangles[triangle];
  MeshPoint seen;
  seen.triangle = triangle;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (to[k] == from[i]) seen.lambda[k] = p.lambda[i];
    }
  }
  return seen;
}

SurfaceFoot SurfaceWalk::FootOn(int triangle, const Vector3d& x) const {
  const TriangleCorners& t = corners_[triangle];
  const TrianglePoint p = ClosestOnTriangle(t[0], t[1], t[2], x);
  return {{triangle, p.lambda}, p.squared_distance};
}

SurfaceFoot SurfaceWalk::FindClosest(const Vector3d& x, const SurfaceFoot& seed,
                                     int component) const {
  SurfaceFoot nearest = seed;
  if (!seed.point.IsValid()) {
    nearest.squared_distance = std::numeric_limits<double>::infinity();
  }
  const BoxTree& tree = bvh_->tree();
  tree.NearestFirst(
      nearest.squared_distance,
      [&](int index) {
        return bvh_->ToFrame(tree.nodes()[index]).SquaredDistance(x);
      },
      [&](int position) {
        const int triangle = tree.order()[position];
        if (component < 0 || component_[triangle] == component) {
          const SurfaceFoot foot = FootOn(triangle, x);
          if (foot.squared_distance < nearest.squared_distance) nearest = foot;
        }
        return nearest.squared_distance;
      });
  return nearest;
}

void SurfaceWalk::OfferFan(int triangle, int corner, const Vector3d& x,
                           SurfaceFoot* best) const {
  const std::vector<Triangle>& triangles = space_.mesh().triangles;
  const int vertex = triangles[triangle][corner];
  int at = triangle, k = corner;
  // Always across the edge that begins in the vertex; the count is for
  // triangles with a vertex twice, where the turn may not close.
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    at = neighbors_[at][k];
    if (at == triangle) return;
    const Triangle& t = triangles[at];
    k = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
    const SurfaceFoot foot = FootOn(at, x);
    if (foot.squared_distance < best->squared_distance) *best = foot;
  }
}

SurfaceFoot SurfaceWalk::Descend(const MeshPoint& from, const Vector3d& x,
                                 SurfaceWay* way) const {
  way->clear();
  SurfaceFoot best = FootOn(from.triangle, x);
  for (;;) {
    way->push_back(best.point);
    const Vector3d& lambda = best.point.lambda;
    const int here = best.point.triangle;
    int zeros = 0, zero = 0, corner = 0;
    for (int k = 0; k < 3; ++k) {
      if (lambda[k] > 0.0) {
        corner = k;
      } else {
        ++zeros;
        zero = k;
      }
    }
    if (zeros == 0) return best;
    if (zeros == 1) {
      const SurfaceFoot across = FootOn(neighbors_[here][(zero + 1) % 3], x);
      if (across.squared_distance < best.squared_distance) best = across;
    } else {
      OfferFan(here, corner, x, &best);
    }
    if (best.point.triangle == here) return best;
  }
}

double SurfaceWalk::Advance(const SurfaceWay& way, double budget,
                            std::size_t* next, MeshPoint* p) const {
  double moved = 0.0;
  while (*next < way.size()) {
    const MeshPoint& end = way[*next];
    const MeshPoint start = SeenFrom(end.triangle, *p);
    const double length = (At(end) - At(start)).norm();
    if (length <= budget - moved) {
      *p = end;
      moved += length;
      ++*next;
      continue;
    }
    const double part = std::max(0.0, budget - moved) / length;
    *p = start;
    p->lambda += part * (end.lambda - start.lambda);
    p->lambda = p->lambda.cwiseMax(0.0);
    p->lambda /= p->lambda.sum();
    return budget;
  }
  return moved;
}

}  // namespace phongpd
