// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include "problems/cli/completion.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

// What stands before the tables.  `path` is the command so far: " scenes
// write". Bash splits --flag=value into three words.
constexpr char kBashHead[] =
    R"(# Completion of phongpd for bash, by: phongpd completion bash
_phongpd() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  local path= i words= files=
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} != -- ]] || return 0
    case "$path ${COMP_WORDS[i]}" in
)";

constexpr char kBashAfterCommands[] = R"(        path+=" ${COMP_WORDS[i]}" ;;
    esac
  done
  if [[ $word == = ]]; then
    word=
  elif [[ $before == = ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
  case "$path $before" in
)";

// A value, or whatever the command takes next.
constexpr char kAfterValues[] = R"(    *)
      case "$path" in
)";

constexpr char kTail[] = R"(      esac
      ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  # Names of files are readline's own to complete, where nothing else is.
  [[ $files ]] || compopt +o default 2>/dev/null
}
complete -o default -F _phongpd phongpd
)";

std::string PathOf(const CommandNode& node) {
  std::string path;
  for (const std::string& name : node.path) path += ' ' + name;
  return path;
}

bool TakesFiles(const Argument& argument) {
  return argument.kind == ValueKind::kFile ||
         argument.kind == ValueKind::kFolder ||
         argument.kind == ValueKind::kScene;
}

// words=... files=... for a value of that argument.
std::string OfferInBash(const Argument& argument,
                        const std::vector<std::string>& families) {
  std::string words;
  if (argument.kind == ValueKind::kScene) words = Joined(families, " ");
  if (argument.kind == ValueKind::kChoice) {
    words = Joined(argument.choices, " ");
  }
  return "words='" + words + "'" + (TakesFiles(argument) ? " files=1" : "");
}

// A line of `case` for each flag that takes a value.
std::string ValueCases(const CommandNode& node,
                       const std::vector<std::string>& families) {
  std::string text;
  for (const Argument& flag : node.flags) {
    if (flag.kind == ValueKind::kNone) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : flag.names) {
      patterns.push_back('\'' + PathOf(node) + ' ' + name + '\'');
    }
    text += "    " + Joined(patterns, "|") + ") " +
            OfferInBash(flag, families) + " ;;\n";
  }
  return text;
}

// What may follow a command where no flag asks for a value: flags if the word
// begins like one, or if there is nothing else.
std::string NextCase(const CommandNode& node,
                     const std::vector<std::string>& families) {
  std::vector<std::string> flags, others;
  for (const Argument& flag : node.flags) {
    flags.insert(flags.end(), flag.names.begin(), flag.names.end());
  }
  for (const CommandNode& below : node.commands) {
    others.push_back(below.path.back());
  }
  bool has_files = false;
  for (const Argument& argument : node.positionals) {
    has_files = has_files || TakesFiles(argument);
    const auto& more =
        argument.kind == ValueKind::kScene ? families : argument.choices;
    others.insert(others.end(), more.begin(), more.end());
  }
  const std::string all_flags = "words='" + Joined(flags, " ") + "'";
  std::string text = "        '" + PathOf(node) + "') ";
  if (others.empty() && !has_files) return text + all_flags + " ;;\n";
  return text + "words='" + Joined(others, " ") + "'" +
         (has_files ? " files=1" : "") + "\n          [[ $word != -* ]] || " +
         all_flags + " ;;\n";
}

}  // namespace

std::string BashCompletion(const CommandNode& program,
                           const std::vector<std::string>& families) {
  std::vector<std::string> paths;
  std::string values, next;
  for (const CommandNode* const node : AllNodes(program)) {
    if (!node->path.empty()) paths.push_back('\'' + PathOf(*node) + '\'');
    values += ValueCases(*node, families);
    next += NextCase(*node, families);
  }
  return kBashHead + ("      " + Joined(paths, "|")) + ")\n" +
         kBashAfterCommands + values + kAfterValues + next + kTail;
}

}  // namespace phongpd::cli
