// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/windows/grid_window.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Half steps: a narrower window has no odd coordinate between its walls.
constexpr std::int64_t kLeastWidth = 4;

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

std::optional<std::array<GridWindow, 2>> GridWindow::Halves() const {
  const GridPoint size = max - min;
  const int axis = LargestAxis(size);
  if (size[axis] < kLeastWidth) return std::nullopt;
  std::array<GridWindow, 2> halves = {*this, *this};
  halves[0].max[axis] = halves[1].min[axis] = (min[axis] + size[axis] / 2) | 1;
  return halves;
}

std::vector<WallPatch> WholeWalls(const GridWindow& window) {
  std::vector<WallPatch> patches;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool is_high : {false, true}) {
      WallPatch patch{axis, is_high, window.min, window.max, -1};
      patch.min[axis] = patch.max[axis] =
          is_high ? window.max[axis] : window.min[axis];
      patches.push_back(patch);
    }
  }
  return patches;
}

Convolution WithWalls(const Convolution& part,
                      const std::vector<WallPatch>& patches) {
  Convolution out;
  out.points.reserve(part.points.size() + 4 * patches.size());
  for (const GridPoint& p : part.points) out.points.push_back(Doubled(p));
  out.facets = part.facets;
  int source = 0;
  for (const ConvolutionFacet& f : part.facets) {
    source = std::max(source, f.source + 1);
  }
  std::unordered_map<GridPoint, int, GridPointHash> corners;
  const auto corner = [&](const GridPoint& p) {
    const auto [it, is_new] =
        corners.emplace(p, static_cast<int>(out.points.size()));
    if (is_new) out.points.push_back(p);
    return it->second;
  };
  for (const WallPatch& patch : patches) {
    // u, v, axis are right-handed: 0, u, u + v, v looks along +axis.
    const int u = (patch.axis + 1) % 3, v = (patch.axis + 2) % 3;
    GridPoint at_u = patch.min, at_v = patch.min;
    at_u[u] = patch.max[u];
    at_v[v] = patch.max[v];
    const int c0 = corner(patch.min), c2 = corner(patch.max);
    int c1 = corner(at_u), c3 = corner(at_v);
    if (patch.is_high) std::swap(c1, c3);
    GridNormal n{};
    n[patch.axis] = patch.is_high ? -1 : 1;
    out.facets.push_back({{c0, c1, c2}, n, source, ContactKind::kNone});
    out.facets.push_back({{c0, c2, c3}, n, source, ContactKind::kNone});
    ++source;
  }
  return out;
}

}  // namespace phongpd::internal
