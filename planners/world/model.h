// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd {

// How much of a world's contact space is built for an answer.  All answers are
// exact: a path that is free in a window is free in the whole.
enum class Model {
  // The least that is enough: the window for planners that only check motions,
  // the whole for others, or again the window if limits refuse the whole.
  kAuto,
  // Only free space (World::Convolution), and of the contact space the part
  // that
  // leads from start to goal (WindowPlanner), or what a metric that is asked
  // for
  // depends on along the iterates of an optimiser (WindowMetric).
  kWindow,
  kFull,
};
const char* ToString(Model model);  // auto, window, full
const std::vector<std::string>& ModelNames();
// Throws InputError starting with `what`.
Model ParseModel(const std::string& text, const std::string& what);

}  // namespace phongpd
