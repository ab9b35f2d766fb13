// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "planners/world/world.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// The status of a free path that keeps less than what is required.
inline constexpr char kClearanceMissed[] = "clearance_missed";

// The clearance or margin that somebody asks a path to keep.
struct ClearanceWish {
  std::string name;             // "clearance", "margin"
  std::optional<Length> asked;  // none: a path keeps what it does
  bool is_own = false;          // by a flag or the scene, not a default
  bool is_required = false;     // less is no answer
};

// Of the planners and of the optimiser; `is_flag`: a flag gave it.
ClearanceWish WishOfPlan(const Scene& scene, bool is_required);
ClearanceWish WishOfTrajectory(const Scene& scene, bool is_flag,
                               bool is_required);

// One sentence where the start or goal of the scene has less than what is asked
// for, so that no path can keep it; empty otherwise.  Of the solids: nothing is
// built.
std::string BeyondTheEnds(const World& world, const Scene& scene,
                          const ClearanceWish& wish);

// Says in a row of results, once it has been judged, what was asked, kept and
// possible: `lengths` gets asked_clearance, start_room and goal_room (Room),
// `clearance_shortfall` is what the path lacks, null without a path or wish.
// Where a wish of somebody's own was missed the reason says so in words; where
// it was required the status is kClearanceMissed and `solved` is false.
void TellClearance(const World& world, const Scene& scene,
                   const ClearanceWish& wish, nlohmann::ordered_json* row);

// Is that the status of the row?
bool IsClearanceMissed(const nlohmann::ordered_json& row);

}  // namespace phongpd
