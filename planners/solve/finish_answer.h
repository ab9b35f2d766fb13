// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "planners/solve/path_answer.h"

// What all answers begin and end with.
namespace phongpd::internal {

// Are start and goal free, on the solids?  Otherwise the answer says which is
// not, and by how much; nothing is built.
bool AreEndsFree(const World& world, const Eigen::Vector3d& start,
                 const Eigen::Vector3d& goal, PathAnswer* answer);

// Whether the window is what to build, by the model asked for: kFull and kAuto
// build `layouts`, and kAuto takes the window where limits refuse that.  Throws
// BuildRefusal where the model is kFull.
bool UsesWindow(const World& world, Model model,
                const std::vector<SpaceLayout>& layouts, std::string* refusal);

// What a path is to keep.
struct ClearanceWish {
  std::string name;             // "clearance", "margin"
  std::optional<Length> asked;  // none: a path keeps what it does
  bool is_own = false;          // somebody's own, not a default
  bool is_required = false;     // less is no answer
};

// One sentence where start or goal have less than is asked for, so that no path
// can keep it; empty otherwise.  Of the solids: nothing is built.
std::string BeyondTheEnds(const World& world, const Eigen::Vector3d& start,
                          const Eigen::Vector3d& goal,
                          const ClearanceWish& wish);

// Judges the answer a second time, on the solids, if that is asked for: a
// refuted one has the status kVerificationFailed and is neither free nor
// solved. Then says what a path lacks of the wish, in words where it is
// somebody's own: kClearanceMissed where it is required.
void Finish(const World& world, const Eigen::Vector3d& start,
            const Eigen::Vector3d& goal, const ClearanceWish& wish,
            bool verifies, PathAnswer* answer);

}  // namespace phongpd::internal
