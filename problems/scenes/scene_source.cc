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
#include "problems/scenes/ompl_app_problem.h"
#include "problems/scenes/scene_library.h"
#include "problems/scenes/turning_families.h"

namespace phongpd {
namespace {

// The one knob of a scene of a robot that turns.
std::string KnobOf(const std::string& family) {
  for (const SceneFamily& one : TurningSceneFamilies()) {
    if (one.name == family) return one.knobs.front().key;
  }
  return "";
}

}  // namespace

SceneSource::SceneSource(const std::string& text, const std::string& root,
                         Repair repair)
    : text_(text), root_(root), repair_(repair), label_(text) {
  const std::size_t colon = text.find(':');
  family_ = text.substr(0, colon);
  const std::vector<std::string> names = SceneFamilyNames();
  const bool is_known =
      std::find(names.begin(), names.end(), family_) != names.end();
  if (!is_known) {
    if (!std::filesystem::exists(text)) {
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
    for (const char* ending : {".csv", ".tsv", ".jsonl", ".xlsx"}) {
      if (std::filesystem::path(text).extension() != ending) continue;
      throw InputError(text +
                       ": expected a scene file, .json, found a table; a path "
                       "of one's own is timed by phongpd retime SCENE PATH");
    }
    is_file_ = true;
    content_ = ReadInputFile(text, "a scene file", kMaxSceneBytes);
    label_ = std::filesystem::path(text).stem().string();
    has_robots_ = content_.find("\"robots\"") != std::string::npos &&
                  HasRobots(ParseJson(content_, text));
    is_ompl_app_ = IsOmplAppProblem(content_);
    turns_ = is_ompl_app_ || (content_.find("\"turns\"") != std::string::npos &&
                              HasTurningRobot(ParseJson(content_, text)));
    return;
  }
  turns_ = IsTurningFamily(family_);
  if (colon == std::string::npos) return;
  std::istringstream settings(text.substr(colon + 1));
  for (std::string setting; std::getline(settings, setting, ',');) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos && turns_) {
      // There is one knob to set.
      const std::string key = KnobOf(family_);
      knobs_[key] = ParseDouble(setting, text + ": " + key);
      continue;
    }
    if (equals == std::string::npos) {
      throw InputError(text + ": expected key=value, found '" + setting + "'");
    }
    const std::string key = setting.substr(0, equals);
    knobs_[key] = ParseDouble(setting.substr(equals + 1), text + ": " + key);
  }
}

Scene SceneSource::Load(std::optional<std::uint64_t> seed) const {
  if (is_ompl_app_) {
    throw InputError(text_ +
                     ": expected a scene of a robot that translates, found a "
                     "problem of OMPL.app, whose robot turns; plan takes it");
  }
  if (is_file_) return ParseSceneFile(content_, text_, root_, repair_);
  std::map<std::string, double> knobs = knobs_;
  if (seed) knobs["seed"] = static_cast<double>(*seed);
  // Of a robot that turns: refused, in words that say what takes it.
  Scene scene = ParseScene(
      turns_ ? MakeTurningScene(family_, knobs_) : MakeScene(family_, knobs),
      text_);
  scene.name = label_;
  return scene;
}

FleetScene SceneSource::LoadFleet() const {
  return ParseFleetSceneFile(content_, text_, root_, repair_);
}

TurningScene SceneSource::LoadTurning() const {
  if (is_ompl_app_) return ParseOmplAppProblem(content_, text_, root_);
  if (is_file_) {
    return ParseTurningSceneFile(content_, text_, root_, repair_);
  }
  TurningScene scene =
      ParseTurningScene(MakeTurningScene(family_, knobs_), text_);
  scene.name = label_;
  return scene;
}

std::string SceneSource::Digest() const {
  internal::ByteWriter writer;
  writer(text_, content_);
  const auto write = [&writer](const TriangleMesh& mesh) {
    writer(mesh.vertices, mesh.triangles);
  };
  if (turns_) {
    const TurningScene scene = LoadTurning();
    write(scene.robot);
    for (const TurningScene::Obstacle& obstacle : scene.obstacles) {
      write(obstacle.mesh);
    }
  } else {
    const Scene scene = Load();
    writer(scene.start, scene.goal);
    write(scene.workspace.robot);
    for (const Solid& obstacle : scene.workspace.obstacles) write(obstacle);
  }
  return internal::ToHex(internal::HashContent(writer.Take()));
}

}  // namespace phongpd
