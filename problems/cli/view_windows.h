// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/contact/contact_space_cache.h"
#include "problems/scenes/scene.h"
#include "viewer/view.h"

// What was built for answers, and words where that cannot be shown.
namespace phongpd::cli {

// What a plan by contact-surface with model window explored follows from its
// scene and this.
struct ExploringRun {
  std::string preset;
  int routes = 0;
  double clearance = 0.0;  // that was sought, the user's unit
};

// Of a row of such a plan.  Throws nlohmann::json::exception.
ExploringRun ExploringRunOf(const nlohmann::json& row);

// Explores that anew and shows the part of the contact space that it is, with
// the box that was searched.  Throws as the plan does.
void ShowExplored(const Scene& scene, const ExploringRun& of,
                  const ContactSpaceCache& cache, View* view);

// Builds what the scene's paths were made in, or takes it from the cache, and
// shows it: the whole contact space, or the model of free space alone with the
// box that was searched.  Throws as World's builds do.
void ShowModel(const Scene& scene, const ContactSpaceCache& cache,
               bool is_window, View* view);

// Notes why no windows are seen behind depths, where none are; `is_table`: they
// come from a table, which does not hold them.
void TellOfDepthWindows(bool is_table, View* view);

}  // namespace phongpd::cli
