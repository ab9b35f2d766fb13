// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

// The program's commands and flags as data, read off the parser itself, so that
// what is made of them (completion, the manual) cannot go stale.
namespace phongpd::cli {

// What a flag or a positional argument takes.
enum class ValueKind {
  kNone,    // nothing: a switch
  kFile,    // a file
  kFolder,  // a folder
  kScene,   // a scene file, or the name of a family
  kChoice,  // one of `choices`
  kOther,   // a number, a length, ...: nothing to offer
};

struct Argument {
  std::vector<std::string> names;  // "--at", "-h"; none of a positional one
  std::string title;               // its value as --help calls it: "X Y Z", "A"
  ValueKind kind = ValueKind::kNone;
  std::vector<std::string> choices;  // of kChoice
  std::string help;
  std::string fallback;  // value if it is not given, if --help tells that
  bool required = false;
  bool repeats = false;  // any number of values
};

struct CommandNode {
  std::vector<std::string> path;  // {"scenes", "write"}; empty for the program
  std::string summary;
  std::string examples;  // what --help ends with
  std::vector<Argument> flags;
  std::vector<Argument> positionals;
  std::vector<CommandNode> commands;
};

// The tree below `app`, in the order of --help.
CommandNode TreeOf(const CLI::App& app);

// The program that `command` belongs to, however deep.
const CLI::App& ProgramOf(const CLI::App& command);

// `root` and all below it, each before those below it.
std::vector<const CommandNode*> AllNodes(const CommandNode& root);

}  // namespace phongpd::cli
