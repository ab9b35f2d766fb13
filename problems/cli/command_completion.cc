// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "problems/cli/command.h"
#include "problems/cli/command_tree.h"
#include "problems/cli/completion.h"
#include "problems/scenes/scene_library.h"

namespace phongpd::cli {
namespace {

int Complete(const CLI::App& program, const std::string& shell) {
  std::vector<std::string> families;
  for (const SceneFamily& family : SceneFamilies()) {
    families.push_back(family.name);
  }
  const CommandNode tree = TreeOf(program);
  std::cout << (shell == "bash"  ? BashCompletion(tree, families)
                : shell == "zsh" ? ZshCompletion(tree, families)
                                 : FishCompletion(tree, families));
  return kDone;
}

}  // namespace

std::string Shortened(const std::string& help, std::size_t length) {
  std::string line = help.substr(0, help.find('\n'));
  if (line.size() <= length) return line;
  const std::size_t end = line.rfind(' ', length);
  line.resize(end == std::string::npos ? length : end);
  while (!line.empty() &&
         std::string(" ,;:.(").find(line.back()) != std::string::npos) {
    line.pop_back();
  }
  return line + " ...";
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
  return [app, shell] { return Complete(ProgramOf(*app), *shell); };
}

}  // namespace phongpd::cli
