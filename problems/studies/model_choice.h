// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planners/world/world.h"

namespace phongpd {

// How much of a world's contact space a study builds:
//   full    all of it,
//   window  free space alone (World::Convolution), which is enough for motion
//           checks and distances from outside,
//   auto    full; window where the limits of a build refuse that.  A study
//           that knows the window to be enough need not ask.
class ModelChoice {
 public:
  // Throws InputError unless `model` is one of the three.
  explicit ModelChoice(const std::string& model = "auto");

  // Decides once for a world, and builds what the full model needs: `layouts`.
  // Throws BuildRefusal where a limit refuses that and the model is full.
  bool UsesWindow(const World& world, const std::vector<SpaceLayout>& layouts);

  // Why auto took the window; empty: it did not.
  const std::string& refusal() const { return refusal_; }

 private:
  std::string model_;
  std::optional<bool> uses_window_;  // not yet decided: none
  std::string refusal_;
};

}  // namespace phongpd
