// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "problems/cli/command.h"
#include "problems/cli/command_tree.h"
#include "problems/cli/manual_page.h"
#include "problems/output/versions.h"

namespace phongpd::cli {

Command AddMan(CLI::App* app) {
  app->footer("Examples:\n  phongpd man | man -l -\n");
  return [app] {
    std::cout << ManualPage(TreeOf(ProgramOf(*app)), Versions()[0].second);
    return kDone;
  };
}

}  // namespace phongpd::cli
