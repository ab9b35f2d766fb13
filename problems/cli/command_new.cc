// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/text.h"
#include "problems/scenes/new_scene.h"
#include "problems/scenes/scene.h"

namespace phongpd::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct NewFlags {
  std::string robot;
  std::string obstacle;
  std::string output;
  std::string repair = "reject";
  bool json = false;
};

// As a scene in that folder names the mesh: relative to it, unless the user
// gave the whole path.
std::string NamedFrom(const fs::path& folder, const std::string& file) {
  const std::size_t end = FilePartOf(file);
  const fs::path path = file.substr(0, end);
  if (path.is_absolute()) return file;
  return fs::proximate(fs::absolute(path), fs::absolute(folder)).string() +
         file.substr(end);
}

Json Told(const NewFlags& flags, const SceneGuess& guess) {
  const auto point = [](const Eigen::Vector3d& p) {
    return Json{p.x(), p.y(), p.z()};
  };
  return {
      {"scene", flags.output},
      {"unit", guess.unit},
      {"start", point(guess.start)},
      {"goal", point(guess.goal)},
      {"bounds",
       {{"min", point(guess.bounds.min)}, {"max", point(guess.bounds.max)}}}};
}

int WriteNew(const NewFlags& flags) {
  OutputFiles outputs;
  const std::string target = AnswerTarget(flags.output);
  DeclareIfNamed(&outputs, target, "--output", {".json", ".jsonc"});
  // Work that somebody has put into a scene is not replaced by guesses.
  RequireFreeName(flags.output);
  if (flags.json) RequireFreeStandardOutput(outputs);
  const Repair repair = ParseRepair(flags.repair, "--repair");
  // Refused here if the scene's readers would refuse it.
  const Solid robot = LoadSolid(flags.robot, repair);
  const Solid obstacle = LoadSolid(flags.obstacle, repair);
  WarnOfUnits(robot.mesh(), flags.robot, obstacle.mesh(), flags.obstacle);
  const SceneGuess guess =
      GuessScene(robot.mesh(), flags.robot, obstacle.mesh(), flags.obstacle);
  const fs::path folder = fs::path(flags.output).parent_path();
  const fs::path from = folder.empty() ? fs::path(".") : folder;
  const std::string text =
      NewSceneText(guess, NamedFrom(from, flags.robot),
                   NamedFrom(from, flags.obstacle), flags.repair);
  outputs.Write(target, text);
  const std::string told = (flags.output.empty() ? "scene" : flags.output) +
                           ": guessed: unit " + guess.unit + " (" + guess.why +
                           "), start, goal and bounds; correct them there\n";
  CommitAndTell(&outputs,
                flags.json ? JsonText(Told(flags, guess)) + '\n' : told);
  return kDone;
}

}  // namespace

Command AddNew(CLI::App* app) {
  auto flags = std::make_shared<NewFlags>();
  app->add_option(
         "ROBOT", flags->robot,
         std::string("Mesh of a solid, which moves (") + kMeshFormats + ")")
      ->required()
      ->type_name("FILE");
  app->add_option("OBSTACLE", flags->obstacle, "Mesh of the other, which stays")
      ->required()
      ->type_name("FILE");
  app->add_option("-o,--output", flags->output,
                  "Scene file, .json, whose name must be free; standard output "
                  "if not set.  Meshes are named relative to it")
      ->type_name("FILE");
  AddRepair(app, &flags->repair);
  AddJson(app, &flags->json, "What was guessed as JSON on standard output");
  AddExamples(app, {"phongpd new tool.stl part.stl --output scene.json",
                    "phongpd new arm.urdf#hand shelf.stl -o scene.json && "
                    "phongpd plan scene.json"});
  return [flags] { return WriteNew(*flags); };
}

}  // namespace phongpd::cli
