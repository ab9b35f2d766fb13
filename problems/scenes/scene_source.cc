// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_source.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/contact/byte_stream.h"
#include "core/contact/content_hash.h"
#include "core/mesh/input_file.h"
#include "core/nearest_name.h"
#include "problems/meshes/any_mesh.h"
#include "problems/output/text.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene_library.h"

namespace phongpd {

SceneSource::SceneSource(const std::string& text, const std::string& root,
                         Repair repair)
    : text_(text), root_(root), repair_(repair), label_(text) {
  const std::size_t colon = text.find(':');
  family_ = text.substr(0, colon);
  const std::vector<SceneFamily>& families = SceneFamilies();
  const bool is_known =
      std::any_of(families.begin(), families.end(),
                  [&](const SceneFamily& f) { return f.name == family_; });
  if (!is_known) {
    if (!std::filesystem::exists(text)) {
      std::vector<std::string> names;
      for (const SceneFamily& family : families) names.push_back(family.name);
      throw InputError(text +
                       ": expected a scene file or a family with knobs, "
                       "FAMILY:key=value,...; found neither (see phongpd "
                       "scenes list)" +
                       DidYouMean(family_, names));
    }
    if (NamesMesh(text)) {
      throw InputError(text +
                       ": expected a scene file, found a mesh; phongpd new "
                       "ROBOT OBSTACLE writes a scene of two meshes");
    }
    is_file_ = true;
    content_ = ReadInputFile(text, "a scene file", kMaxSceneBytes);
    label_ = std::filesystem::path(text).stem().string();
    has_robots_ = content_.find("\"robots\"") != std::string::npos &&
                  HasRobots(ParseJson(content_, text));
    turns_ = content_.find("\"turns\"") != std::string::npos &&
             HasTurningRobot(ParseJson(content_, text));
    return;
  }
  if (colon == std::string::npos) return;
  std::istringstream settings(text.substr(colon + 1));
  for (std::string setting; std::getline(settings, setting, ',');) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw InputError(text + ": expected key=value, found '" + setting + "'");
    }
    const std::string key = setting.substr(0, equals);
    knobs_[key] = ParseDouble(setting.substr(equals + 1), text + ": " + key);
  }
}

Scene SceneSource::Load(std::optional<std::uint64_t> seed) const {
  if (is_file_) return ParseSceneFile(content_, text_, root_, repair_);
  std::map<std::string, double> knobs = knobs_;
  if (seed) knobs["seed"] = static_cast<double>(*seed);
  Scene scene = ParseScene(MakeScene(family_, knobs), text_);
  scene.name = label_;
  return scene;
}

FleetScene SceneSource::LoadFleet() const {
  return ParseFleetSceneFile(content_, text_, root_, repair_);
}

TurningScene SceneSource::LoadTurning() const {
  return ParseTurningSceneFile(content_, text_, root_, repair_);
}

std::string SceneSource::Digest() const {
  internal::ByteWriter writer;
  writer(text_, content_);
  Workspace workspace;
  if (turns_) {
    workspace = LoadTurning().workspace;
  } else {
    const Scene scene = Load();
    writer(scene.start, scene.goal);
    workspace = scene.workspace;
  }
  writer(workspace.robot.mesh().vertices, workspace.robot.mesh().triangles);
  for (const Solid& obstacle : workspace.obstacles) {
    writer(obstacle.mesh().vertices, obstacle.mesh().triangles);
  }
  return internal::ToHex(internal::HashContent(writer.Take()));
}

}  // namespace phongpd
