// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/serve_view.h"

#include <spawn.h>

#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/minkowski/build_stop.h"
#include "problems/cli/command.h"
#include "problems/cli/loopback_server.h"
#include "problems/cli/scene_solver.h"
#include "problems/cli/solve_desk.h"
#include "problems/output/json_text.h"
#include "problems/output/programs.h"
#include "viewer/view_page.h"

extern char** environ;

namespace phongpd::cli {
namespace {

// As a shell reads it back.
std::string ShellQuoted(const std::string& word) {
  constexpr char kPlain[] =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=,+-#@"
      "%";
  if (!word.empty() && word.front() != '#' &&
      word.find_first_not_of(kPlain) == std::string::npos) {
    return word;
  }
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

}  // namespace

std::string ServeCommand(const std::vector<std::string>& things,
                         const std::string& root, const std::string& repair) {
  std::string command = "phongpd view";
  for (const std::string& thing : things) command += ' ' + ShellQuoted(thing);
  if (!root.empty()) command += " --root " + ShellQuoted(root);
  if (repair != "reject") command += " --repair " + ShellQuoted(repair);
  return command + " --serve";
}

void OpenOnDisplay(const std::string& path) {
  if (std::getenv("DISPLAY") == nullptr &&
      std::getenv("WAYLAND_DISPLAY") == nullptr) {
    return;
  }
  std::string program = FindProgram({"xdg-open"});
  if (program.empty()) return;
  std::string argument = path;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments,
                  environ) != 0) {
    Note("xdg-open could not be started; open the file yourself");
  }
}

void ServeView(View view, const ServedScene& scene,
               const ContactSpaceCache& cache, const ServeOptions& options) {
  LoopbackOptions loopback;
  loopback.port = options.port;
  LoopbackServer server(loopback);
  const std::unique_ptr<SceneSolver> solver =
      SolverOf(scene, cache, options.seconds);
  SolveDesk desk(
      [&solver](const std::string& question,
                const std::function<bool()>& is_cancelled) {
        return JsonText(solver->Answer(question, is_cancelled));
      },
      CancelBuilds, options.seconds);
  view.is_served = true;
  const std::string page = ViewPage(view);
  std::cout << server.address() << std::endl;
  Note(
      "serving on this machine alone, with a new address each time; Ctrl-C "
      "ends it");
  if (options.shows) OpenOnDisplay(server.address());
  server.Run({page, [&desk](const std::string& body) { return desk.Ask(body); },
              [&desk] { return desk.Cancel(); }});
  throw InputError("--serve: the server has stopped: " + server.address());
}

}  // namespace phongpd::cli
