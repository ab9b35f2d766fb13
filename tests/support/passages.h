// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>

#include "planners/retraction/contact_model.h"
#include "problems/scenes/scene.h"

namespace phongpd::testing {

// A scene with a narrow passage and its merged contact space.
struct Passage {
  Scene scene;
  std::shared_ptr<const ContactModel> model;
};

// The scene family (hole, tunnel, keyhole, bugtrap, ...) with a channel of
// side `delta` in q; δ < 0 closes it: the infeasible twin.  A rotation seed
// > 0 turns everything: coplanar coincidences go, rounding comes.
Passage MakePassage(const std::string& family, double delta,
                    int rotation_seed = 0);
// The family with any of its knobs.
Passage MakePassage(const std::string& family,
                    const std::map<std::string, double>& knobs);

// C_obj = [−1, 1]³, in bounds [−2, 2]³.
std::shared_ptr<const ContactModel> BoxModel();

}  // namespace phongpd::testing
