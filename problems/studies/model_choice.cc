// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/model_choice.h"

#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_refusal.h"

namespace phongpd {

ModelChoice::ModelChoice(const std::string& model) : model_(model) {
  if (model != "auto" && model != "window" && model != "full") {
    throw InputError("model: expected auto, window or full, found '" + model +
                     "'");
  }
}

bool ModelChoice::UsesWindow(const World& world,
                             const std::vector<SpaceLayout>& layouts) {
  if (uses_window_) return *uses_window_;
  if (model_ != "window") {
    try {
      for (const SpaceLayout layout : layouts) world.Spaces(layout);
    } catch (const BuildRefusal& refusal) {
      if (model_ == "full") throw;
      refusal_ = refusal.what();
    }
  }
  uses_window_ = model_ == "window" || !refusal_.empty();
  return *uses_window_;
}

}  // namespace phongpd
