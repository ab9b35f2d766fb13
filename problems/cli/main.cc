// SPDX-License-Identifier: GPL-3.0-or-later
#include <cctype>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "problems/cli/command.h"
#include "problems/versions.h"

namespace phongpd::cli {
namespace {

std::string VersionText() {
  std::string text;
  for (const auto& [name, version] : Versions()) {
    text += (text.empty() ? "" : "\n") + name + ' ' + version;
  }
  return text;
}

// Errors are one line, whatever the message they come from looks like.
int Fail(ExitCode code, const std::string& message) {
  std::string line;
  for (const char c : message) {
    if (c != '\n' && c != '\r') {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  std::cerr << "phongpd: " << line << '\n';
  return code;
}

// CLI11 takes -1 for a number but -.5 for a flag.
std::vector<std::string> Arguments(int argc, char** argv) {
  std::vector<std::string> arguments;
  for (int i = argc - 1; i > 0; --i) {  // CLI11 wants them in reverse
    std::string argument = argv[i];
    if (argument.size() > 2 && argument[0] == '-' && argument[1] == '.' &&
        std::isdigit(static_cast<unsigned char>(argument[2])) != 0) {
      argument.insert(1, "0");
    }
    arguments.push_back(argument);
  }
  return arguments;
}

int Run(int argc, char** argv) {
  CLI::App app(
      "Continuous penetration depth (PhongPD) on exact contact spaces.\n"
      "Exit codes: 0 done, 1 ran but found no answer, 2 bad input (nothing is "
      "written), 3 internal error.",
      "phongpd");
  app.set_version_flag("--version", VersionText);
  std::vector<std::pair<CLI::App*, Command>> commands;
  const auto add = [&](const char* name, const char* summary,
                       Command (*declare)(CLI::App*)) {
    CLI::App* const command = app.add_subcommand(name, summary);
    commands.emplace_back(command, declare(command));
  };
  add("contact-space", "Build the contact space of two meshes",
      AddContactSpace);
  add("query", "Penetration depth at the points of a CSV file", AddQuery);
  add("motion", "Phong and Euclidean depth along a straight motion", AddMotion);
  add("optimize", "Optimise a trajectory with Ipopt, exactly judged",
      AddOptimize);
  add("compare", "Compare penetration metrics in the trajectory optimiser",
      AddCompare);
  add("plan", "Plan a path, or prove that there is none", AddPlan);
  add("scenes", "List or write the procedural scenes", AddScenes);
  add("reproduce", "Pack a command with its inputs, to report what went wrong",
      AddReproduce);

  try {
    app.parse(Arguments(argc, argv));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help, version
    return Fail(kBadInput, std::string(error.what()) + " (see --help)");
  }
  for (const auto& [command, run] : commands) {
    if (command->parsed()) return run();
  }
  std::string names;
  for (const auto& entry : commands) {
    names += (names.empty() ? "" : ", ") + entry.first->get_name();
  }
  return Fail(kBadInput, "expected a command: " + names + " (see --help)");
}

}  // namespace
}  // namespace phongpd::cli

int main(int argc, char** argv) {
  using namespace phongpd::cli;
  try {
    const int code = Run(argc, argv);
    std::cout.flush();
    if (!std::cout) return Fail(kBadInput, "standard output: write failed");
    return code;
  } catch (const phongpd::InputError& error) {
    return Fail(kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return Fail(kInternalError, "internal error: out of memory");
  } catch (const std::exception& error) {
    return Fail(kInternalError,
                std::string("internal error: ") + error.what() +
                    "; to report it: phongpd reproduce --output report.json -- "
                    "and the command as you gave it");
  }
}
