// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/grid_window.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

GridPoint Doubled(const GridPoint& p) { return p + p; }

}  // namespace

GridWindow GridWindow::Around(const Vector3d& q, double reach) {
  GridWindow window;
  for (int k = 0; k < 3; ++k) {
    window.min[k] = 2 * std::llround(std::floor(q[k] - reach)) - 1;
    window.max[k] = 2 * std::llround(std::ceil(q[k] + reach)) + 1;
  }
  return window;
}

BoundingBox GridWindow::Box() const {
  return {0.5 * ToDouble(min), 0.5 * ToDouble(max)};
}

double GridWindow::WallDistance(const Vector3d& q) const {
  const BoundingBox box = Box();
  return (q - box.min).cwiseMin(box.max - q).minCoeff();
}

Convolution WithWalls(const Convolution& part, const GridWindow& window) {
  Convolution out;
  out.points.reserve(part.points.size() + 8);
  for (const GridPoint& p : part.points) out.points.push_back(Doubled(p));
  out.facets = part.facets;
  int source = 0;
  for (const ConvolutionFacet& f : part.facets) {
    source = std::max(source, f.source + 1);
  }
  const int first = static_cast<int>(out.points.size());
  for (int corner = 0; corner < 8; ++corner) {
    GridPoint p;
    for (int k = 0; k < 3; ++k) {
      p[k] = (corner >> k & 1) != 0 ? window.max[k] : window.min[k];
    }
    out.points.push_back(p);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
    for (const int high : {0, 1}) {
      // u, v, axis are right-handed: 0, u, u + v, v looks along +axis.
      const int c0 = first + (high << axis);
      int c1 = c0 + u, c3 = c0 + v;
      const int c2 = c0 + u + v;
      if (high != 0) std::swap(c1, c3);
      GridNormal n{};
      n[axis] = high != 0 ? -1 : 1;
      out.facets.push_back({{c0, c1, c2}, n, source, ContactKind::kEdges});
      out.facets.push_back({{c0, c2, c3}, n, source, ContactKind::kEdges});
      ++source;
    }
  }
  return out;
}

}  // namespace phongpd::internal
