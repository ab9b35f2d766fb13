// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/contact/contact_space_cache.h"
#include "problems/cli/scene_solver.h"
#include "viewer/view.h"

// The viewer as a tool: its page, and who answers it.
namespace phongpd::cli {

struct ServeOptions {
  int port = 0;           // of the loopback address; 0: any that is free
  double seconds = 60.0;  // that an answer may take
  bool shows = true;      // opens the page in the user's browser
};

// Serves the view of the scene, and answers its page (SceneSolver), until a
// signal ends the process: prints the address, token and all, on standard
// output first.  Throws InputError where the port cannot be had.
[[noreturn]] void ServeView(View view, const ServedScene& scene,
                            const ContactSpaceCache& cache,
                            const ServeOptions& options);

// "phongpd view THING... --serve", to be pasted into a shell: what a page that
// nobody serves tells its reader to run.
std::string ServeCommand(const std::vector<std::string>& things,
                         const std::string& root, const std::string& repair);

// In the user's browser, if there is a display; does not wait for it.
void OpenOnDisplay(const std::string& path);

}  // namespace phongpd::cli
