// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contact/contact_space_cache.h"
#include "problems/pictures/viewer/view.h"
#include "problems/scenes/scene.h"

// What was built for answers, and words where that cannot be shown.
namespace phongpd::cli {

// Builds what the scene's paths were made in, or takes it from the cache, and
// shows it: the whole contact space, or the model of free space alone with the
// box that was searched.  Throws as World's builds do.
void ShowModel(const Scene& scene, const ContactSpaceCache& cache,
               bool is_window, View* view);

// Notes why no windows are seen behind depths, where none are; `is_table`: they
// come from a table, which does not hold them.
void TellOfDepthWindows(bool is_table, View* view);

}  // namespace phongpd::cli
