// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/view_json_modules.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/projection/phong_field.h"
#include "viewer/display_mesh.h"
#include "viewer/page_numbers.h"
#include "viewer/wasm/page_modules.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

// For the probe and the solver: not as it is shown but as it is, in doubles.
Json ExactJson(const TriangleMesh& mesh) {
  std::string positions;
  for (const Vector3d& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) AppendNumber(&positions, p[k]);
  }
  return {{"positions", Base64(positions)},
          {"indices", Base64(CornerBytes(mesh))}};
}

// Can metrics be made of it?  Parts of contact spaces are drawn, too: of bounds
// the walls alone, which look inwards.
bool IsWhole(const ViewMesh& mesh) {
  if (!(SignedVolume(mesh.mesh) > 0.0)) return false;
  try {
    ContactSpace::Parts parts;
    parts.mesh = mesh.mesh;
    const ContactSpace space(std::move(parts), mesh.name);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

nlohmann::ordered_json ProbeJson(const View& view,
                                 std::vector<std::string>* notes) {
  BoundingBox box;
  std::size_t triangles = 0;
  for (const ViewMesh& mesh : view.meshes) {
    if (mesh.role != ViewRole::kContactSpace || mesh.mesh.triangles.empty()) {
      continue;
    }
    const BoundingBox own = ComputeBounds(mesh.mesh);
    box = triangles == 0 ? own
                         : BoundingBox{box.min.cwiseMin(own.min),
                                       box.max.cwiseMax(own.max)};
    triangles += mesh.mesh.triangles.size();
  }
  if (triangles == 0) return nullptr;
  if (triangles > kMaxProbeTriangles) {
    notes->push_back("The live probe is left out: contact spaces of " +
                     std::to_string(triangles) + " triangles, at most " +
                     std::to_string(kMaxProbeTriangles));
    return nullptr;
  }
  for (const ViewMesh& mesh : view.meshes) {
    if (mesh.role != ViewRole::kContactSpace || IsWhole(mesh)) continue;
    if (mesh.name == kConvolutionName) {
      notes->push_back(
          "There is no live probe: free space alone was modelled, which tells "
          "no depth.");
      return nullptr;
    }
    notes->push_back(
        "There is no live probe: of the contact space only a part that bounds "
        "free space is shown.");
    return nullptr;
  }
  const std::string module(ProbeModule());
  if (module.empty()) {
    notes->push_back(
        "There is no live probe: this program was built without clang, lld, "
        "wasi-libc and libc++ for wasm32.");
    return nullptr;
  }
  Json json = {{"module", Base64(module)},
               {"length", view.length > 0.0 ? view.length : box.Diagonal()},
               {"smoothing_length", kDefaultSmoothingLength},
               {"spaces", Json::array()}};
  for (const ViewMesh& mesh : view.meshes) {
    if (mesh.role == ViewRole::kContactSpace && !mesh.mesh.triangles.empty()) {
      json["spaces"].push_back(ExactJson(mesh.mesh));
    }
  }
  return json;
}

nlohmann::ordered_json SolverJson(const View& view) {
  const std::string module(SolverModule());
  if (module.empty() || view.is_served || !view.ends.empty() ||
      !view.movers.empty()) {
    return nullptr;
  }
  Json obstacles = Json::array();
  std::size_t triangles = view.robot.triangles.size();
  for (const ViewMesh& mesh : view.meshes) {
    if (mesh.role != ViewRole::kObstacle) continue;
    triangles += mesh.mesh.triangles.size();
    obstacles.push_back(ExactJson(mesh.mesh));
  }
  if (obstacles.empty() || triangles > kMaxSolverTriangles) return nullptr;
  return {{"module", Base64(module)},
          {"robot", ExactJson(view.robot)},
          {"obstacles", obstacles}};
}

}  // namespace phongpd::internal
