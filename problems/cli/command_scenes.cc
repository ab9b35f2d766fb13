// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "problems/cli/command.h"
#include "problems/output/output_files.h"
#include "problems/output/text.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/scene_library.h"

namespace phongpd::cli {
namespace {

struct Flags {
  std::string name;
  std::vector<std::string> settings;
  std::string output;
  std::string meshes;
};

void ListKnobs(const std::vector<SceneKnob>& knobs) {
  for (const SceneKnob& knob : knobs) {
    std::cout << "    " << knob.key << '=' << FormatDouble(knob.value) << "  "
              << knob.meaning << '\n';
  }
}

int List() {
  for (const SceneFamily& family : SceneFamilies()) {
    std::cout << family.name << ": " << family.summary << '\n';
    ListKnobs(family.knobs);
  }
  std::cout << "Every scene has these knobs too:\n";
  ListKnobs(CommonSceneKnobs());
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

int Write(const Flags& flags) {
  if (flags.output.empty() && flags.meshes.empty()) {
    throw InputError("scenes write: expected --output, --meshes or both");
  }
  std::string text;
  Scene scene;
  {
    // Gone before anything is written: to destroy it takes memory.
    const nlohmann::ordered_json json =
        MakeScene(flags.name, Knobs(flags.settings));
    // Built in any case: a scene whose solids cannot be made is bad input.
    scene = ParseScene(json, "scene " + flags.name);
    text = json.dump(2) + '\n';
  }
  const TriangleMesh obstacle = JoinedObstacle(scene.workspace);

  OutputFiles outputs;
  if (!flags.output.empty()) {
    outputs.Declare(flags.output);
    outputs.Write(flags.output, text);
  }
  const auto write = [&](const TriangleMesh& mesh, const std::string& path) {
    outputs.Declare(path);
    WriteMeshTo(&outputs, path, mesh);
  };
  if (!flags.meshes.empty()) {
    outputs.MakeDirectory(flags.meshes);
    write(scene.workspace.robot, flags.meshes + "/robot.off");
    write(obstacle, flags.meshes + "/obstacle.off");
  }
  const std::string skipped = SkippedObstaclesNote(scene);
  CommitAndTell(&outputs,
                flags.name + ": robot " +
                    std::to_string(scene.workspace.robot.triangles.size()) +
                    ", obstacle " + std::to_string(obstacle.triangles.size()) +
                    " triangles\n" + skipped + (skipped.empty() ? "" : "\n"));
  return kDone;
}

}  // namespace

Command AddScenes(CLI::App* app) {
  auto flags = std::make_shared<Flags>();
  app->require_subcommand(1);
  const CLI::App* const list =
      app->add_subcommand("list", "Names and knobs with their defaults");
  CLI::App* const write = app->add_subcommand("write", "Write one scene");
  write->add_option("name", flags->name, "See scenes list")
      ->required()
      ->type_name("FAMILY");
  write->add_option("--set", flags->settings, "Set a knob")
      ->expected(1)
      ->take_all()
      ->type_name("KEY=VALUE");
  write->add_option("--output", flags->output, "Scene file (JSON)")
      ->type_name("FILE");
  write
      ->add_option("--meshes", flags->meshes,
                   "Directory for robot.off and obstacle.off, which the "
                   "other commands read")
      ->type_name("DIR");
  return [flags, list] { return list->parsed() ? List() : Write(*flags); };
}

}  // namespace phongpd::cli
