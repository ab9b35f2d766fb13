// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_side.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "constraints/rigid/distinct_triangles.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_range.h"
#include "core/solid/mesh_examination.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

bool IsClosedSurface(const TriangleMesh& mesh) {
  return BadEdges(ExamineTopology(mesh)) == 0;
}

BoundingBox BoundsOfAll(const std::vector<TriangleMesh>& meshes) {
  BoundingBox all = ComputeBounds(meshes.front());
  for (const TriangleMesh& mesh : meshes) {
    const BoundingBox box = ComputeBounds(mesh);
    all.min = all.min.cwiseMin(box.min);
    all.max = all.max.cwiseMax(box.max);
  }
  return all;
}

}  // namespace

bool RigidSide::Holds(const Vector3d& x) const {
  return std::any_of(
      solids.begin(), solids.end(),
      [&](const TriangleBvh& solid) { return solid.WindingNumber(x) > 0; });
}

void RequireRigidMeshes(const std::vector<TriangleMesh>& meshes,
                        const std::string& what) {
  if (meshes.empty()) {
    throw InputError("rigid judge: expected a mesh of the " + what +
                     ", found none");
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string name =
        "rigid judge: " + what +
        (meshes.size() == 1 ? "" : ", mesh " + std::to_string(i));
    const MeshReport report = ExamineTopology(meshes[i]);
    if (report.bad_indices > 0) {
      throw InputError(name + ": expected indices of its " +
                       std::to_string(meshes[i].vertices.size()) +
                       " vertices, found " +
                       std::to_string(report.bad_indices) + " others");
    }
    if (report.non_finite_vertices > 0) {
      throw InputError(name + ": expected finite coordinates, found " +
                       std::to_string(report.non_finite_vertices) +
                       " vertices with NaN or infinity");
    }
    if (meshes[i].triangles.empty()) {
      throw InputError(name + ": expected triangles, found none");
    }
    RequireInRange(meshes[i], name);
  }
}

RigidFrame RigidFrameOf(const std::vector<TriangleMesh>& robot,
                        const std::vector<TriangleMesh>& obstacles) {
  const BoundingBox box = BoundsOfAll(obstacles), own = BoundsOfAll(robot);
  RigidFrame frame;
  frame.center = box.Center();
  const double size =
      std::max((box.max - frame.center).maxCoeff(),
               own.min.cwiseAbs().cwiseMax(own.max.cwiseAbs()).maxCoeff());
  int exponent = 0;
  std::frexp(size, &exponent);
  // A power of two that is finite, also for the smallest numbers.
  if (size > 0.0) frame.scale = std::ldexp(1.0, -std::max(exponent, -1000));
  return frame;
}

RigidSide MakeRigidSide(const std::vector<TriangleMesh>& meshes,
                        const Vector3d& center, double scale) {
  RigidSide side;
  std::vector<RigidOrigin> origins;
  std::vector<TriangleCorners> corners, given;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    TriangleMesh mesh = meshes[i];
    for (Vector3d& v : mesh.vertices) v = (v - center) * scale;
    int count = 0;
    const std::vector<int> label = LabelComponents(mesh, &count);
    std::vector<bool> has_seed(static_cast<std::size_t>(count), false);
    const std::vector<TriangleCorners> own = CornersOf(mesh);
    const std::vector<TriangleCorners> unmoved = CornersOf(meshes[i]);
    given.insert(given.end(), unmoved.begin(), unmoved.end());
    for (std::size_t k = 0; k < own.size(); ++k) {
      origins.push_back({static_cast<int>(i), static_cast<int>(k)});
      const auto component = static_cast<std::size_t>(label[k]);
      if (!has_seed[component]) side.seeds.push_back(own[k][0]);
      has_seed[component] = true;
    }
    corners.insert(corners.end(), own.begin(), own.end());
    if (IsClosedSurface(meshes[i])) side.solids.emplace_back(mesh);
  }
  // Faces that are stored twice meet what they meet once.
  std::vector<TriangleCorners> kept;
  for (const std::size_t k : DistinctTriangles(given)) {
    side.origins.push_back(origins[k]);
    side.given.push_back(given[k]);
    kept.push_back(corners[k]);
  }
  side.tree = MakeRigidTree(std::move(kept));
  return side;
}

}  // namespace phongpd::internal
