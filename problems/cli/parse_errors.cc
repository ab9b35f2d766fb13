// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/parse_errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <regex>
#include <sstream>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "problems/meshes/any_mesh.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

using Strings = std::vector<std::string>;

Strings NamesBelow(const CLI::App& app) {
  Strings names;
  for (const CLI::App* const one : app.get_subcommands(nullptr)) {
    names.push_back(one->get_name());
  }
  return names;
}

bool Holds(const Strings& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void AddFlags(const CLI::App& app, Strings* flags) {
  for (const CLI::Option* const option : app.get_options()) {
    for (const std::string& flag : option->get_snames()) {
      flags->push_back("-" + flag);
    }
    for (const std::string& flag : option->get_lnames()) {
      flags->push_back("--" + flag);
    }
  }
}

// "scenes" needs one of "list" and "write"; flags come after it.
void RequireCommandBelow(const CLI::App& command, const Strings& arguments) {
  const Strings names = NamesBelow(command);
  if (names.empty()) return;
  const bool is_alone = arguments.size() < 2;
  const std::string found = is_alone ? "" : arguments[arguments.size() - 2];
  if (!is_alone && (Holds(names, found) || found[0] == '-')) return;
  throw InputError(command.get_name() + ": expected " + Joined(names, " or ") +
                   ", found " + (is_alone ? "nothing" : "'" + found + "'") +
                   DidYouMean(found, names));
}

// What a user meant for a flag: "--at" or "-at", and no "-5", "-inf" or "-".
bool LooksLikeFlag(const std::string& argument) {
  if (argument.compare(0, 2, "--") == 0) return argument.size() > 2;
  static const std::regex number("-(inf|nan|infinity)(,.*)?",
                                 std::regex::icase);
  return argument.size() > 1 && argument[0] == '-' &&
         std::isalpha(static_cast<unsigned char>(argument[1])) != 0 &&
         !std::regex_match(argument, number);
}

bool IsKnownFlag(const std::string& argument, const Strings& flags) {
  return Holds(flags, argument.substr(0, argument.find('=')));
}

// In front of the first command, or of all: "--version".
void RefuseUnknownFirst(const CLI::App& app, const std::string& first) {
  if (!LooksLikeFlag(first)) return;
  Strings flags;
  AddFlags(app, &flags);
  if (IsKnownFlag(first, flags)) return;
  throw InputError("expected a command or one of " + Joined(flags) +
                   ", found '" + first + "' (see phongpd --help)" +
                   DidYouMean(first, flags));
}

// A file in place of a command: somebody has forgotten the command.
std::string WhereItBelongs(const std::string& name) {
  std::error_code none;
  if (!std::filesystem::exists(name, none)) return "";
  return "; a command stands before its files: phongpd check " + name;
}

// "--at: At least 3 required but received 2" and what else CLI11 says, each in
// our words; $1 is the flag or argument.
struct Rule {
  std::regex pattern;
  std::string words;
};

const std::vector<Rule>& Rules() {
  static const std::vector<Rule> rules = {
      {std::regex("(.+) is required"), "expected $1, found none"},
      {std::regex("(.+): At least (.+) required but received (.+)"),
       "$1: expected at least $2 values, found $3"},
      {std::regex("(.+): At [Mm]ost (.+) required but received (.+)"),
       "$1: expected at most $2 values, found $3"},
      {std::regex("(.+): ([0-9]+) required (.*) missing"),
       "$1: expected $2 of $3, found none"},
      {std::regex("Could not convert: (.+) = (-?[0-9.eE+-]+)"),
       "$1: expected a whole number within range, found $2"},
      {std::regex("Could not convert: (.+) = (.*)"),
       "$1: expected a whole number, found $2"},
      {std::regex("(.+) requires (.+)"), "$1: expected with $2, found without"},
      {std::regex("(.+) excludes (.+)"),
       "$1: expected without $2, found with it"},
  };
  return rules;
}

// "--metric: phongg not in {phong,euclidean}"
std::string ChoiceExplained(const std::string& text) {
  static const std::regex pattern(R"((.+?): (.*) not in \{(.*)\})");
  std::smatch match;
  if (!std::regex_match(text, match, pattern)) return "";
  Strings names;
  std::istringstream list(match[3].str());
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return match[1].str() + ": expected one of " + Joined(names) + "; found '" +
         match[2].str() + "'" + DidYouMean(match[2].str(), names);
}

// Of one scene, in front of which meshes are put.
bool TakesScene(const std::string& command) {
  return command == "plan" || command == "optimize" || command == "compare" ||
         command == "retime";
}

// "The following arguments were not expected: b a", of which the first that was
// given is the one to name.
std::string TooMuch(const CLI::ExtrasError& error, const Strings& arguments) {
  const std::string what = error.what();
  std::istringstream list(what.substr(what.find(": ") + 2));
  const Strings extras{std::istream_iterator<std::string>(list), {}};
  for (std::size_t i = arguments.size(); i-- > 0;) {
    if (!Holds(extras, arguments[i])) continue;
    if (NamesMesh(arguments[i]) && i + 1 < arguments.size() &&
        NamesMesh(arguments[i + 1]) && TakesScene(arguments.back())) {
      return arguments.back() + ": expected a scene file, found two meshes; " +
             "phongpd new " + arguments[i + 1] + ' ' + arguments[i] +
             " writes a scene of them";
    }
    const std::size_t count = std::max<std::size_t>(extras.size(), 1);
    return arguments.back() + ": expected no more, found '" + arguments[i] +
           "'" +
           (count == 1 ? ""
                       : " and " + std::to_string(count - 1) + " after it");
  }
  return what;
}

}  // namespace

void RefuseUnknownNames(const CLI::App& app, const Strings& arguments) {
  if (arguments.empty()) return;
  RefuseUnknownFirst(app, arguments.back());
  if (arguments.back().empty() || arguments.back()[0] == '-') return;
  const std::string& name = arguments.back();
  const Strings names = NamesBelow(app);
  if (!Holds(names, name)) {
    throw InputError("expected a command, found '" + name +
                     "' (see phongpd --help)" + DidYouMean(name, names) +
                     WhereItBelongs(name));
  }
  const CLI::App& command = *app.get_subcommand(name);
  RequireCommandBelow(command, arguments);
  Strings flags;
  AddFlags(command, &flags);
  for (const CLI::App* const below : command.get_subcommands(nullptr)) {
    AddFlags(*below, &flags);
  }
  for (std::size_t i = arguments.size() - 1; i-- > 0;) {
    if (arguments[i] == "--") return;
    if (!LooksLikeFlag(arguments[i]) || IsKnownFlag(arguments[i], flags)) {
      continue;
    }
    const std::string flag = arguments[i].substr(0, arguments[i].find('='));
    throw InputError(name + ": expected one of its flags, found '" + flag +
                     "' (see phongpd " + name + " --help)" +
                     DidYouMean(flag, flags));
  }
}

std::string Explained(const CLI::ParseError& error, const CLI::App& app,
                      const Strings& arguments) {
  const std::string what = error.what();
  const std::string command =
      !arguments.empty() && Holds(NamesBelow(app), arguments.back())
          ? arguments.back() + " "
          : "";
  const std::string see = " (see phongpd " + command + "--help)";
  const std::string choice = ChoiceExplained(what);
  if (!choice.empty()) return choice;
  if (const auto* const extras =
          dynamic_cast<const CLI::ExtrasError*>(&error)) {
    return TooMuch(*extras, arguments) + see;
  }
  for (const Rule& rule : Rules()) {
    if (!std::regex_match(what, rule.pattern)) continue;
    return std::regex_replace(what, rule.pattern, rule.words) + see;
  }
  return what + see;
}

}  // namespace phongpd::cli
