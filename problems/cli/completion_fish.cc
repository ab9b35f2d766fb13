// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include "problems/cli/completion.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

// __phongpd_at scenes write: is that the command that is being completed?
constexpr char kFishHead[] =
    R"(# Completion of phongpd for fish, by: phongpd completion fish
function __phongpd_at
    set -l path
    for word in (commandline -opc)[2..-1]
        switch (string join -- ' ' $path $word)
            case )";

constexpr char kFishAfterCommands[] = R"(
                set path $path $word
        end
    end
    test "$path" = "$argv"
end
complete -c phongpd -f
)";

std::string QuotedForFish(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '\'';
}

std::string At(const CommandNode& node) {
  const std::string path = Joined(node.path, " ");
  return "complete -c phongpd -n '__phongpd_at" +
         (path.empty() ? "" : ' ' + path) + '\'';
}

// How fish is told what a value may be.
std::string OfferInFish(const Argument& argument,
                        const std::vector<std::string>& families) {
  switch (argument.kind) {
    case ValueKind::kFile:
      return " -F";
    case ValueKind::kFolder:
      return " -f -a '(__fish_complete_directories)'";
    case ValueKind::kScene:
      return " -F -a " + QuotedForFish(Joined(families, " "));
    case ValueKind::kChoice:
      return " -f -a " + QuotedForFish(Joined(argument.choices, " "));
    case ValueKind::kNone:
    case ValueKind::kOther:
      break;
  }
  return " -f";
}

std::string Flag(const CommandNode& node, const Argument& flag,
                 const std::vector<std::string>& families) {
  std::string line = At(node);
  for (const std::string& name : flag.names) {
    line += name[1] == '-' ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (flag.kind != ValueKind::kNone)
    line += " -r" + OfferInFish(flag, families);
  return line + " -d " + QuotedForFish(Shortened(flag.help)) + '\n';
}

}  // namespace

std::string FishCompletion(const CommandNode& program,
                           const std::vector<std::string>& families) {
  std::vector<std::string> paths;
  std::string lines;
  for (const CommandNode* const node : AllNodes(program)) {
    if (!node->path.empty()) {
      paths.push_back(QuotedForFish(Joined(node->path, " ")));
    }
    for (const CommandNode& below : node->commands) {
      lines += At(*node) + " -a " + below.path.back() + " -d " +
               QuotedForFish(Shortened(below.summary)) + '\n';
    }
    for (const Argument& argument : node->positionals) {
      lines += At(*node) + OfferInFish(argument, families) + '\n';
    }
    for (const Argument& flag : node->flags) {
      lines += Flag(*node, flag, families);
    }
  }
  return kFishHead + Joined(paths, " ") + kFishAfterCommands + lines;
}

}  // namespace phongpd::cli
