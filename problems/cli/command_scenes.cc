// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/counted.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/text.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/scene_library.h"
#include "problems/scenes/turning_families.h"
#include "problems/scenes/turning_scene.h"

namespace phongpd::cli {
namespace {

struct ScenesFlags {
  std::string name;
  std::vector<std::string> settings;
  std::string output;
  std::string meshes;
  bool json = false;
};

using Json = nlohmann::ordered_json;

void ListKnobs(const std::vector<SceneKnob>& knobs) {
  for (const SceneKnob& knob : knobs) {
    std::cout << "    " << knob.key << '=' << FormatDouble(knob.value) << "  "
              << knob.meaning << '\n';
  }
}

Json KnobsJson(const std::vector<SceneKnob>& knobs) {
  Json list = Json::array();
  for (const SceneKnob& knob : knobs) {
    list.push_back({{"key", knob.key},
                    {"default", knob.value},
                    {"meaning", knob.meaning}});
  }
  return list;
}

Json FamiliesJson(const std::vector<SceneFamily>& families) {
  Json list = Json::array();
  for (const SceneFamily& family : families) {
    list.push_back({{"name", family.name},
                    {"summary", family.summary},
                    {"knobs", KnobsJson(family.knobs)}});
  }
  return list;
}

int ListAsJson() {
  const Json list = {
      {"families", FamiliesJson(SceneFamilies())},
      {"common_knobs", KnobsJson(CommonSceneKnobs())},
      {"turning_families", FamiliesJson(TurningSceneFamilies())}};
  std::cout << JsonText(list, 2) << '\n';
  return kDone;
}

void ListFamilies(const std::vector<SceneFamily>& families) {
  for (const SceneFamily& family : families) {
    std::cout << family.name << ": " << family.summary << '\n';
    ListKnobs(family.knobs);
  }
}

int List() {
  ListFamilies(SceneFamilies());
  std::cout << "Every scene above has these knobs too:\n";
  ListKnobs(CommonSceneKnobs());
  std::cout << "Scenes of a robot that turns, for plan and view, each with one "
               "knob, as alpha:1.2:\n";
  ListFamilies(TurningSceneFamilies());
  return kDone;
}

std::map<std::string, double> Knobs(const std::vector<std::string>& settings) {
  std::map<std::string, double> knobs;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw InputError("--set: expected key=value, found '" + setting + "'");
    }
    const std::string key = setting.substr(0, equals);
    knobs[key] = ParseDouble(setting.substr(equals + 1), "--set " + key);
  }
  return knobs;
}

// A scene as it is written, and what of its solids is told and written.
struct WrittenScene {
  std::string text;
  TriangleMesh robot, obstacle;  // all obstacles in one
  std::string skipped;
};

WrittenScene MakeWritten(const ScenesFlags& flags) {
  const std::map<std::string, double> knobs = Knobs(flags.settings);
  const std::string name = "scene " + flags.name;
  WrittenScene written;
  // Built in any case: a scene whose solids cannot be made is bad input.
  if (IsTurningFamily(flags.name)) {
    const Json json = MakeTurningScene(flags.name, knobs);
    const TurningScene scene = ParseTurningScene(json, name);
    written.text = JsonText(json, 2) + '\n';
    written.robot = scene.robot;
    for (const TurningScene::Obstacle& one : scene.obstacles) {
      written.obstacle = Joined(written.obstacle, one.mesh);
    }
    return written;
  }
  const Json json = MakeScene(flags.name, knobs);
  const Scene scene = ParseScene(json, name);
  written.text = JsonText(json, 2) + '\n';
  written.robot = scene.workspace.robot;
  written.obstacle = JoinedObstacle(scene.workspace);
  written.skipped = SkippedObstaclesNote(scene);
  return written;
}

int Write(const ScenesFlags& flags) {
  // With neither a file nor a folder the scene goes to standard output.
  const bool is_asked = !flags.output.empty() || flags.meshes.empty();
  const std::string target = is_asked ? AnswerTarget(flags.output) : "";
  // The parsed scene is gone before anything is written: to destroy it takes
  // memory.
  const WrittenScene written = MakeWritten(flags);
  OutputFiles outputs;
  DeclareIfNamed(&outputs, target, "--output", {".json", ".jsonc"});
  if (flags.json) RequireFreeStandardOutput(outputs);
  const auto write = [&](const TriangleMesh& mesh, const std::string& path) {
    outputs.Declare(path);
    WriteMeshTo(&outputs, path, mesh);
  };
  if (!flags.meshes.empty()) {
    outputs.MakeDirectory(flags.meshes);
    write(written.robot, flags.meshes + "/robot.off");
    write(written.obstacle, flags.meshes + "/obstacle.off");
  }
  if (is_asked) outputs.Write(target, written.text);
  const std::size_t robot = written.robot.triangles.size();
  const std::size_t obstacle = written.obstacle.triangles.size();
  const std::string& skipped = written.skipped;
  const Json told = {{"scene", flags.name},
                     {"robot_triangles", robot},
                     {"obstacle_triangles", obstacle},
                     {"note", skipped}};
  CommitAndTell(&outputs, flags.json
                              ? JsonText(told) + '\n'
                              : flags.name + ": robot " +
                                    std::to_string(robot) + ", obstacle " +
                                    Counted(obstacle, "triangle") + '\n' +
                                    skipped + (skipped.empty() ? "" : "\n"));
  return kDone;
}

}  // namespace

Command AddScenes(CLI::App* app) {
  auto flags = std::make_shared<ScenesFlags>();
  app->require_subcommand(1);
  CLI::App* const list =
      app->add_subcommand("list", "Names and knobs with their defaults");
  AddJson(list, &flags->json, "Names, knobs, defaults and meanings as JSON");
  CLI::App* const write = app->add_subcommand("write", "Write one scene");
  write->add_option("name", flags->name, "See scenes list")
      ->required()
      ->type_name("FAMILY");
  write->add_option("--set", flags->settings, "Set a knob")
      ->expected(1)
      ->take_all()
      ->type_name("KEY=VALUE");
  write
      ->add_option("--output", flags->output,
                   "Scene file (JSON); standard output "
                   "if neither it nor --meshes is set")
      ->type_name("FILE");
  write
      ->add_option("--meshes", flags->meshes,
                   "Directory for robot.off and obstacle.off, which the "
                   "other commands read")
      ->type_name("DIR");
  AddJson(write, &flags->json,
          "What was written as JSON on standard output (the scene is JSON in "
          "any case)");
  AddExamples(app, {"phongpd scenes list",
                    "phongpd scenes write tunnel --set delta=0.01 --output "
                    "tunnel.json",
                    "phongpd scenes write ball_wrench --meshes wrench",
                    "phongpd scenes write alpha --set gap=1.2 --output "
                    "alpha.json"});
  AddExamples(list, {"phongpd scenes list",
                     "phongpd scenes list --json | jq '.families[].name'"});
  AddExamples(write, {"phongpd scenes write tunnel --set delta=0.01 > t.json",
                      "phongpd scenes write ball_wrench --meshes wrench"});
  return [flags, list] {
    if (!list->parsed()) return Write(*flags);
    return flags->json ? ListAsJson() : List();
  };
}

}  // namespace phongpd::cli
