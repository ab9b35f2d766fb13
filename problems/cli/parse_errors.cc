// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/parse_errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <regex>
#include <sstream>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
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
      {std::regex("Could not convert: (.+) = (.*)"),
       "$1: expected a number within range, found $2"},
      {std::regex("(.+) requires (.+)"), "$1: expected with $2, found without"},
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

}  // namespace

void RefuseUnknownNames(const CLI::App& app, const Strings& arguments) {
  if (arguments.empty() || arguments.back()[0] == '-') return;
  const std::string& name = arguments.back();
  const Strings names = NamesBelow(app);
  if (!Holds(names, name)) {
    throw InputError("expected a command, found '" + name +
                     "' (see phongpd --help)" + DidYouMean(name, names));
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
    if (arguments[i].compare(0, 2, "--") != 0) continue;
    const std::string flag = arguments[i].substr(0, arguments[i].find('='));
    if (Holds(flags, flag)) continue;
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
  for (const Rule& rule : Rules()) {
    if (!std::regex_match(what, rule.pattern)) continue;
    return std::regex_replace(what, rule.pattern, rule.words) + see;
  }
  return what + see;
}

}  // namespace phongpd::cli
