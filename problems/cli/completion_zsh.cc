// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>
#include <vector>

#include "problems/cli/completion.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

// Of a command with commands below it, "_phongpd_scenes" say: names first, then
// what the named one takes.
constexpr char kDispatch[] = R"(  if (( CURRENT == 2 )); then
    _describe command commands
    [[ $words[CURRENT] != -* ]] || _arguments $flags
    return
  fi
  local name=$words[2]
  (( $+functions[FUNCTION_$name] )) || return 1
  shift words
  (( CURRENT -= 1 ))
  FUNCTION_$name
)";

// `text` in single quotes, `special` ones behind a backslash.
std::string QuotedForZsh(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + '\'';
}

std::string Guarded(const std::string& text, const std::string& special) {
  std::string guarded;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) guarded += '\\';
    guarded += c;
  }
  return guarded;
}

std::string FunctionOf(const CommandNode& node) {
  std::string name = "_phongpd";
  for (const std::string& part : node.path) name += '_' + part;
  return name;
}

// ":title:action" of a value; of three numbers, three of them.
std::string Values(const Argument& argument) {
  const std::string title = Guarded(argument.title, ":[]");
  switch (argument.kind) {
    case ValueKind::kNone:
      return "";
    case ValueKind::kFile:
      return ':' + title + ":_files";
    case ValueKind::kFolder:
      return ':' + title + ":_files -/";
    case ValueKind::kScene:
      return ':' + title + ":_phongpd__scene";
    case ValueKind::kChoice:
      return ':' + title + ":(" + Joined(argument.choices, " ") + ')';
    case ValueKind::kOther:
      break;
  }
  std::string values;
  for (std::size_t i = 0; i <= title.size();) {
    const std::size_t end = std::min(title.find(' ', i), title.size());
    values += ':' + title.substr(i, end - i) + ": ";
    i = end + 1;
  }
  return values;
}

// One word of _arguments for each name of a flag.
std::string FlagsOf(const CommandNode& node) {
  std::string lines;
  for (const Argument& flag : node.flags) {
    for (const std::string& name : flag.names) {
      // --flag=value is a word, too.
      const bool may_join =
          flag.kind != ValueKind::kNone && name.compare(0, 2, "--") == 0;
      lines += "    " +
               QuotedForZsh((flag.repeats ? "*" : "") + name +
                            (may_join ? "=" : "") + '[' +
                            Guarded(Shortened(flag.help), "[]:\\") + ']' +
                            Values(flag)) +
               '\n';
    }
  }
  return lines;
}

std::string Positionals(const CommandNode& node) {
  std::string lines;
  for (const Argument& argument : node.positionals) {
    lines += "    " +
             QuotedForZsh((argument.repeats ? "*" : "") + Values(argument)) +
             '\n';
  }
  return lines;
}

std::string Function(const CommandNode& node) {
  const std::string name = FunctionOf(node);
  std::string text = name + "() {\n";
  if (node.commands.empty()) {
    return text + "  local -a flags=(\n" + FlagsOf(node) + Positionals(node) +
           "  )\n  _arguments $flags\n}\n";
  }
  text += "  local -a commands=(\n";
  for (const CommandNode& below : node.commands) {
    text += "    " +
            QuotedForZsh(Guarded(below.path.back(), ":") + ':' +
                         Guarded(Shortened(below.summary), "\\")) +
            '\n';
  }
  std::string dispatch = kDispatch;
  for (std::size_t at; (at = dispatch.find("FUNCTION")) != std::string::npos;) {
    dispatch.replace(at, 8, name);
  }
  return text + "  )\n  local -a flags=(\n" + FlagsOf(node) + "  )\n" +
         dispatch + "}\n";
}

}  // namespace

std::string ZshCompletion(const CommandNode& program,
                          const std::vector<std::string>& families) {
  std::string text =
      "#compdef phongpd\n"
      "# Completion of phongpd for zsh, by: phongpd completion zsh\n"
      "_phongpd__scene() {\n"
      "  local -a families=(" +
      Joined(families, " ") +
      ")\n"
      "  _alternative 'families:family:compadd -a families' "
      "'files:file:_files'\n"
      "}\n";
  for (const CommandNode* const node : AllNodes(program)) {
    text += Function(*node);
  }
  // Autoloaded from a folder of $fpath it completes at once; sourced, or
  // evaluated, it registers itself.
  return text +
         "if [[ $funcstack[1] == _phongpd ]]; then\n"
         "  _phongpd \"$@\"\n"
         "else\n"
         "  compdef _phongpd phongpd\n"
         "fi\n";
}

}  // namespace phongpd::cli
