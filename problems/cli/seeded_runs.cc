// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/seeded_runs.h"

#include <iostream>
#include <utility>

#include "problems/cli/command.h"

namespace phongpd::cli {

void AddScene(CLI::App* app, SeededRunFlags* flags) {
  app->add_option("scene", flags->scene,
                  "Scene file, or FAMILY:key=value,... (see scenes list)")
      ->required()
      ->type_name("SCENE");
  AddRoot(app, &flags->root);
}

void AddRuns(CLI::App* app, const std::string& seed_help,
             SeededRunFlags* flags) {
  app->add_option("--seed", flags->seed, seed_help)
      ->check(CLI::NonNegativeNumber)
      ->type_name("S")
      ->capture_default_str();
  app->add_option("--runs", flags->runs, "Runs, with seeds S, S+1, ...")
      ->type_name("N")
      ->capture_default_str();
}

void AddRowOutput(CLI::App* app, SeededRunFlags* flags) {
  app->add_option("--output", flags->output, "JSON Lines, one object a run")
      ->required()
      ->type_name("FILE");
}

void AddPictures(CLI::App* app, SeededRunFlags* flags) {
  app->add_option("--html", flags->html,
                  "Page with the contact space, the paths and the robot, to "
                  "turn and zoom; needs nothing from elsewhere")
      ->type_name("FILE");
  app->add_option("--svg", flags->svg, "The same as a still picture")
      ->type_name("FILE");
}

SeededRuns::SeededRuns(const SeededRunFlags& flags, const std::string& header)
    : flags_(flags), header_(header + '\n') {
  outputs_.Declare(flags.output);
  if (!flags.html.empty()) outputs_.Declare(flags.html);
  if (!flags.svg.empty()) outputs_.Declare(flags.svg);
}

void SeededRuns::Add(const nlohmann::ordered_json& row, const NamedPath& path,
                     const std::string& line, const std::string& why) {
  rows_ += row.dump() + '\n';
  paths_.push_back(path);
  are_all_answered_ = are_all_answered_ && path.is_free;
  if (outputs_.UseStandardOutput()) return;
  std::cout << std::exchange(header_, "") << line << '\n';
  if (!why.empty()) std::cout << "  " << why << '\n';
}

void SeededRuns::Write(PathScene scene) {
  outputs_.Write(flags_.output, rows_);
  scene.paths = paths_;
  if (!flags_.html.empty()) outputs_.Write(flags_.html, PathPage(scene));
  if (!flags_.svg.empty()) outputs_.Write(flags_.svg, PathSvg(scene));
}

int SeededRuns::Commit() {
  outputs_.Commit();
  return are_all_answered_ ? kDone : kNoAnswer;
}

}  // namespace phongpd::cli
