// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_carving.h"

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

// Strictly between the faces, which are cuts of the grid.
bool Holds(const BoundingBox& box, const Vector3d& p) {
  return (box.min.array() < p.array()).all() &&
         (p.array() < box.max.array()).all();
}

bool AnyHolds(const Boxes& boxes, const Vector3d& p) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const BoundingBox& box) { return Holds(box, p); });
}

// The cells of the grid through all faces of `boxes` within `frame` whose
// centres are solid.
Json Cells(const BoundingBox& frame, const Boxes& boxes,
           const std::function<bool(const Vector3d&)>& is_solid) {
  std::array<std::vector<double>, 3> cuts;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> all = {frame.min[axis], frame.max[axis]};
    for (const BoundingBox& box : boxes) {
      all.push_back(box.min[axis]);
      all.push_back(box.max[axis]);
    }
    std::sort(all.begin(), all.end());
    // Faces that differ by rounding are one.
    const double rounding = 1e-12 * (frame.max[axis] - frame.min[axis]);
    for (const double cut : all) {
      if (cut < frame.min[axis] || cut > frame.max[axis]) continue;
      if (!cuts[axis].empty() && cut - cuts[axis].back() <= rounding) continue;
      cuts[axis].push_back(cut);
    }
  }
  const auto middle = [&cuts](int axis, std::size_t i) {
    return 0.5 * (cuts[axis][i] + cuts[axis][i + 1]);
  };
  Json layers = Json::array();
  for (std::size_t k = 0; k + 1 < cuts[2].size(); ++k) {
    Json rows = Json::array();
    for (std::size_t j = 0; j + 1 < cuts[1].size(); ++j) {
      std::string row;
      for (std::size_t i = 0; i + 1 < cuts[0].size(); ++i) {
        const Vector3d center(middle(0, i), middle(1, j), middle(2, k));
        row += is_solid(center) ? '#' : '.';
      }
      rows.push_back(row);
    }
    layers.push_back(rows);
  }
  return {{"type", "cells"},
          {"x", cuts[0]},
          {"y", cuts[1]},
          {"z", cuts[2]},
          {"layers", layers}};
}

}  // namespace

Json CellsShape(const Boxes& solid) {
  BoundingBox frame = solid.front();
  for (const BoundingBox& box : solid) {
    frame.min = frame.min.cwiseMin(box.min);
    frame.max = frame.max.cwiseMax(box.max);
  }
  return Cells(frame, solid,
               [&](const Vector3d& p) { return AnyHolds(solid, p); });
}

Json CarvedShape(const BoundingBox& block, const Boxes& free,
                 const Boxes& robot) {
  Boxes swept;
  for (const BoundingBox& f : free) {
    for (const BoundingBox& r : robot) {
      swept.push_back({f.min + r.min, f.max + r.max});
    }
  }
  return Cells(block, swept,
               [&](const Vector3d& p) { return !AnyHolds(swept, p); });
}

Boxes Channel(const std::vector<Vector3d>& polyline, double width) {
  Boxes boxes;
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    const Vector3d& a = polyline[i - 1];
    const Vector3d& b = polyline[i];
    boxes.push_back({a.cwiseMin(b).array() - 0.5 * width,
                     a.cwiseMax(b).array() + 0.5 * width});
  }
  return boxes;
}

}  // namespace phongpd
