// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "problems/cli/command.h"
#include "problems/cli/command_tree.h"
#include "problems/cli/completion.h"
#include "problems/scenes/turning_families.h"

namespace phongpd::cli {
namespace {

// A shell asks the program that is being typed: phongpd __complete WORD...
// prints an offer a line, its help behind a tab, then ":files" or ":folders" if
// their names are right, too.

constexpr char kBash[] =
    R"sh(# Completion of phongpd for bash, by: phongpd completion bash
_phongpd() {
  local word=${COMP_WORDS[COMP_CWORD]} line names=
  COMPREPLY=()
  while IFS= read -r line; do
    case $line in
      :*) names=1 ;;
      "${word#=}"*) COMPREPLY+=("${line%%$'\t'*}") ;;
    esac
  done < <("${COMP_WORDS[0]/#\~/$HOME}" __complete \
    "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  # Names of files are readline's own to complete, where nothing else is.
  [[ $names ]] || compopt +o default 2>/dev/null
}
complete -o default -F _phongpd phongpd
)sh";

// Autoloaded from a folder of $fpath it completes at once; sourced, or
// evaluated, it registers itself.
constexpr char kZsh[] =
    R"sh(#compdef phongpd
# Completion of phongpd for zsh, by: phongpd completion zsh
_phongpd() {
  local line names
  local -a offers
  for line in ${(f)"$("${${(Q)words[1]}/#\~/$HOME}" __complete \
      "${(@Q)words[2,CURRENT-1]}" "${(Q)PREFIX}" 2>/dev/null)"}; do
    case $line in
      :*) names=$line ;;
      *) offers+=("${${line//:/\\:}/$'\t'/:}") ;;
    esac
  done
  [[ -z $offers ]] || _describe offer offers
  [[ -z $names ]] || compset -P '--*='
  case $names in
    :files) _files ;;
    :folders) _files -/ ;;
  esac
}
if [[ $funcstack[1] == _phongpd ]]; then
  _phongpd "$@"
else
  compdef _phongpd phongpd
fi
)sh";

constexpr char kFish[] =
    R"sh(# Completion of phongpd for fish, by: phongpd completion fish
function __phongpd_offers
    set -l words (commandline -opc)
    set -l word (commandline -ct)
    set -l flag (string match -r -- '^--[^=]*=' "$word")
    set -l value (string replace -- "$flag" '' "$word")
    for line in ($words[1] __complete $words[2..-1] "$word" 2>/dev/null)
        switch $line
            case :files
                __fish_complete_path "$value" | string replace -r '^' -- "$flag"
            case :folders
                __fish_complete_directories "$value" | string replace -r '^' -- "$flag"
            case '*'
                echo $line
        end
    end
end
complete -c phongpd -f -a '(__phongpd_offers)'
)sh";

const std::map<std::string, const char*>& Scripts() {
  static const std::map<std::string, const char*> scripts = {
      {"bash", kBash}, {"zsh", kZsh}, {"fish", kFish}};
  return scripts;
}

}  // namespace

int PrintOffers(const CLI::App& program,
                const std::vector<std::string>& words) {
  const Offers offers = OffersFor(TreeOf(program), SceneFamilyNames(), words);
  for (const Offer& offer : offers.words) {
    std::cout << offer.word << (offer.help.empty() ? "" : "\t") << offer.help
              << '\n';
  }
  if (offers.names == ValueKind::kFile) std::cout << ":files\n";
  if (offers.names == ValueKind::kFolder) std::cout << ":folders\n";
  return kDone;
}

Command AddCompletion(CLI::App* app) {
  auto shell = std::make_shared<std::string>();
  app->add_option("shell", *shell, "Whose completion to print")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  app->footer(
      "Examples:\n"
      "  source <(phongpd completion bash)\n"
      "  phongpd completion zsh >\"${fpath[1]}/_phongpd\"\n"
      "  phongpd completion fish >~/.config/fish/completions/phongpd.fish\n");
  return [shell] {
    std::cout << Scripts().at(*shell);
    return kDone;
  };
}

}  // namespace phongpd::cli
