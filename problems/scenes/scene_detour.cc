// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_detour.h"

#include <algorithm>

namespace phongpd {
namespace {

using Eigen::Vector3d;

// The face of a box around `inner` that a point outside it is pushed to.
struct BoxFace {
  int axis = -1;  // −1: the point is not outside `inner`
  bool is_max = false;
};

BoxFace FaceOf(const Vector3d& p, const BoundingBox& inner) {
  BoxFace face;
  double most = 1e-6 * inner.Diagonal();
  for (int axis = 0; axis < 3; ++axis) {
    const double below = inner.min[axis] - p[axis];
    const double above = p[axis] - inner.max[axis];
    if (std::max(below, above) <= most) continue;
    most = std::max(below, above);
    face = {axis, above > below};
  }
  return face;
}

}  // namespace

std::vector<Vector3d> PathAround(const Vector3d& start, const Vector3d& goal,
                                 const BoundingBox& inner) {
  const BoxFace from = FaceOf(start, inner), to = FaceOf(goal, inner);
  if (from.axis < 0 || to.axis < 0) return {};
  const double gap = 0.05 * inner.Diagonal();
  const Vector3d min = inner.min.cwiseMin(start).cwiseMin(goal).array() - gap;
  const Vector3d max = inner.max.cwiseMax(start).cwiseMax(goal).array() + gap;
  const auto pushed = [&](Vector3d p, const BoxFace& face) {
    p[face.axis] = face.is_max ? max[face.axis] : min[face.axis];
    return p;
  };
  std::vector<Vector3d> path = {start, pushed(start, from)};
  if (from.axis != to.axis) {
    path.push_back(pushed(path.back(), to));
  } else if (from.is_max != to.is_max) {
    const BoxFace side = {(from.axis + 1) % 3, true};
    path.push_back(pushed(path.back(), side));
    path.push_back(pushed(path.back(), to));
  }
  path.push_back(pushed(goal, to));
  path.push_back(goal);
  return path;
}

}  // namespace phongpd
