// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/turning_families.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "core/number_text.h"
#include "problems/scenes/rigid_scenes.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

Json PointJson(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Json ShapeJson(const TriangleMesh& mesh) {
  Json shape = {{"type", "triangles"},
                {"vertices", Json::array()},
                {"triangles", Json::array()}};
  for (const Eigen::Vector3d& v : mesh.vertices) {
    shape["vertices"].push_back(PointJson(v));
  }
  for (const Triangle& t : mesh.triangles) {
    shape["triangles"].push_back({t[0], t[1], t[2]});
  }
  return shape;
}

void SetEnd(const std::string& end, const RobotPose& pose, Json* json) {
  (*json)[end] = PointJson(pose.position);
  const Eigen::Matrix3d rotation = pose.orientation.toRotationMatrix();
  if (rotation == Eigen::Matrix3d::Identity()) return;
  Json& rows = (*json)[end + "_rotation"] = Json::array();
  for (int i = 0; i < 9; ++i) rows.push_back(rotation(i / 3, i % 3));
}

const RigidSceneFamily* Find(const std::string& name) {
  const std::vector<RigidSceneFamily>& families = RigidSceneFamilies();
  const auto found =
      std::find_if(families.begin(), families.end(),
                   [&](const RigidSceneFamily& f) { return f.name == name; });
  return found == families.end() ? nullptr : &*found;
}

}  // namespace

const std::vector<SceneFamily>& TurningSceneFamilies() {
  static const std::vector<SceneFamily> families = [] {
    std::vector<SceneFamily> list;
    for (const RigidSceneFamily& f : RigidSceneFamilies()) {
      list.push_back(
          {f.name,
           f.summary,
           {{f.key, f.value,
             f.knob + ", " + Rounded(f.min) + " to " + Rounded(f.max)}}});
    }
    return list;
  }();
  return families;
}

bool IsTurningFamily(const std::string& name) { return Find(name) != nullptr; }

Json MakeTurningScene(const std::string& name,
                      const std::map<std::string, double>& knobs) {
  const RigidSceneFamily* family = Find(name);
  if (family == nullptr) {
    std::vector<std::string> names;
    for (const RigidSceneFamily& f : RigidSceneFamilies()) {
      names.push_back(f.name);
    }
    throw InputError("scene: expected one of " + Joined(names) + "; found '" +
                     name + "'" + DidYouMean(name, names));
  }
  double value = family->value;
  for (const auto& [key, number] : knobs) {
    if (key != family->key) {
      throw InputError("scene " + name + ": expected its one knob " +
                       family->key + "; found '" + key + "'");
    }
    value = number;
  }
  const RigidScene scene = MakeRigidScene(name + ":" + FormatDouble(value));
  Json json = {{"name", name},
               {"robot", {{"turns", true}, {"shape", ShapeJson(scene.robot)}}},
               {"obstacles", Json::array()},
               {"bounds",
                {{"min", PointJson(scene.bounds.min)},
                 {"max", PointJson(scene.bounds.max)}}}};
  for (const TriangleMesh& obstacle : scene.obstacles) {
    json["obstacles"].push_back({{"shape", ShapeJson(obstacle)}});
  }
  SetEnd("start", scene.start, &json);
  SetEnd("goal", scene.goal, &json);
  return json;
}

std::vector<std::string> SceneFamilyNames() {
  std::vector<std::string> names;
  for (const SceneFamily& family : SceneFamilies()) {
    names.push_back(family.name);
  }
  for (const SceneFamily& family : TurningSceneFamilies()) {
    names.push_back(family.name);
  }
  return names;
}

}  // namespace phongpd
