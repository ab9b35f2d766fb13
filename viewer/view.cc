// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/view.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

void Extend(BoundingBox* box, const Vector3d& point) {
  box->min = box->min.cwiseMin(point);
  box->max = box->max.cwiseMax(point);
}

void Extend(BoundingBox* box, const BoundingBox& other) {
  if (other.IsEmpty()) return;
  Extend(box, other.min);
  Extend(box, other.max);
}

}  // namespace

const char* ToString(ViewRole role) {
  switch (role) {
    case ViewRole::kObstacle:
      return "obstacle";
    case ViewRole::kContactSpace:
      return "contact";
    case ViewRole::kMesh:
      break;
  }
  return "mesh";
}

std::vector<Vector3d> FirstWay(const View& view) {
  for (const NamedPath& path : view.paths) {
    if (!path.points.empty()) return path.points;
  }
  if (!view.motion.positions.empty()) return view.motion.positions;
  std::vector<Vector3d> way;
  for (const ViewAnswer& answer : view.answers) way.push_back(answer.position);
  return way;
}

BoundingBox ViewBounds(const View& view) {
  BoundingBox box = ComputeBounds(TriangleMesh());
  for (const ViewMesh& mesh : view.meshes) {
    Extend(&box, ComputeBounds(mesh.mesh));
  }
  const auto take = [&](const BoundingBox& body, const Vector3d& q) {
    Extend(&box, q);
    if (!body.IsEmpty()) Extend(&box, BoundingBox{q + body.min, q + body.max});
  };
  const BoundingBox robot = ComputeBounds(view.robot);
  const auto visit = [&](const Vector3d& q) { take(robot, q); };
  for (const NamedPath& path : view.paths) {
    const BoundingBox own =
        path.robot.triangles.empty() ? robot : ComputeBounds(path.robot);
    for (const Vector3d& q : path.points) take(own, q);
  }
  for (const ViewMover& mover : view.movers) {
    const BoundingBox own = ComputeBounds(mover.mesh);
    for (const Vector3d& q : mover.points) {
      if (own.IsEmpty()) continue;
      Extend(&box, BoundingBox{q + own.min, q + own.max});
    }
  }
  for (const Vector3d& q : view.motion.positions) visit(q);
  for (const ViewAnswer& answer : view.answers) visit(answer.position);
  if (view.start) visit(*view.start);
  if (view.goal) visit(*view.goal);
  if (box.IsEmpty()) Extend(&box, robot);
  if (box.IsEmpty()) {
    return {Vector3d::Constant(-0.5), Vector3d::Constant(0.5)};
  }
  return box;
}

}  // namespace phongpd
