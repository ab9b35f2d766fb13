// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "problems/scenes/scene_recipes.h"

// The knobs that every family has, and the scene file they lead to.
namespace phongpd {

// The scene of a family; `knobs` holds all of its knobs and the common ones.
//  - seed > 0 draws start and goal: within the layout's freedom, or at
//    opposite ends of the contact space in a random direction such that the
//    straight line collides.
//  - rotation_seed > 0 turns robot, obstacles, start and goal by one random
//    rotation.  Bounds of a sealed layout become the obstacle `bounds_shell`,
//    others the box around the turned ones.
//  - q becomes scale · q + offset · (1, 1, 1), the obstacles likewise; the
//    robot is scaled.
// A witness is written where the route gives one, and `feasible` where it is
// known.  Throws InputError "scene NAME: ..." for knobs out of range and for
// shapes that cannot be made.
nlohmann::ordered_json PlacedScene(const SceneRecipe& recipe, KnobValues knobs);

}  // namespace phongpd
