// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/command_tree.h"

#include <CLI/CLI.hpp>
#include <map>
#include <sstream>
#include <utility>

namespace phongpd::cli {
namespace {

// {"a", "b"} of CLI11's "TEXT:{a,b}"; none of any other type.
std::vector<std::string> ChoicesIn(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.rfind('}');
  std::vector<std::string> choices;
  if (begin == std::string::npos || end == std::string::npos) return choices;
  std::istringstream list(type.substr(begin + 1, end - begin - 1));
  for (std::string one; std::getline(list, one, ',');) choices.push_back(one);
  return choices;
}

ValueKind KindOf(const std::string& title) {
  static const std::map<std::string, ValueKind> kinds = {
      {"FILE", ValueKind::kFile},    {"DIR", ValueKind::kFolder},
      {"SCENE", ValueKind::kScene},  {"THING", ValueKind::kScene},
      {"FAMILY", ValueKind::kScene},
  };
  const auto found = kinds.find(title);
  return found == kinds.end() ? ValueKind::kOther : found->second;
}

Argument ToArgument(const CLI::Option& option) {
  Argument argument;
  for (const std::string& name : option.get_snames()) {
    argument.names.push_back('-' + name);
  }
  for (const std::string& name : option.get_lnames()) {
    argument.names.push_back("--" + name);
  }
  argument.help = option.get_description();
  argument.fallback = option.get_default_str();
  argument.required = option.get_required();
  argument.repeats =
      option.get_items_expected_max() >= CLI::detail::expected_max_vector_size;
  if (option.get_items_expected_max() == 0) return argument;
  const std::string type = option.get_type_name();
  argument.choices = ChoicesIn(type);
  argument.title = type.substr(0, type.find(':'));
  argument.kind =
      argument.choices.empty() ? KindOf(argument.title) : ValueKind::kChoice;
  if (!option.nonpositional()) {
    // "A FILE": what it is called says more than what it is.
    argument.title = option.get_name(true);
  } else if (argument.kind == ValueKind::kChoice) {
    argument.title = "WORD";
  }
  return argument;
}

CommandNode NodeOf(const CLI::App& app, const std::vector<std::string>& path) {
  CommandNode node;
  node.path = path;
  node.summary = app.get_description();
  node.examples = app.get_footer();
  for (const CLI::Option* const option : app.get_options()) {
    const bool is_flag = option->nonpositional();
    (is_flag ? node.flags : node.positionals).push_back(ToArgument(*option));
  }
  for (const CLI::App* const below : app.get_subcommands(nullptr)) {
    std::vector<std::string> path_below = path;
    path_below.push_back(below->get_name());
    node.commands.push_back(NodeOf(*below, path_below));
  }
  return node;
}

void Collect(const CommandNode& node, std::vector<const CommandNode*>* nodes) {
  nodes->push_back(&node);
  for (const CommandNode& below : node.commands) Collect(below, nodes);
}

}  // namespace

CommandNode TreeOf(const CLI::App& app) { return NodeOf(app, {}); }

const CLI::App& ProgramOf(const CLI::App& command) {
  const CLI::App* app = &command;
  while (app->get_parent() != nullptr) app = app->get_parent();
  return *app;
}

std::vector<const CommandNode*> AllNodes(const CommandNode& root) {
  std::vector<const CommandNode*> nodes;
  Collect(root, &nodes);
  return nodes;
}

}  // namespace phongpd::cli
