// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "problems/cli/timed_answer.h"
#include "problems/scenes/fleet_scene.h"

// Motions of several robots, as phongpd optimize writes them.
namespace phongpd::cli {

// As AnswerInTime, of all robots of a scene: the output is one document, or,
// where it is a table or lines, one file for each robot, FILE.ID.csv, all on
// one clock.  `explains`: the command whose flags --explain tells of; null: it
// was not asked for.
int AnswerFleet(FleetScene scene, const TimedFlags& flags,
                const CLI::App* explains);

}  // namespace phongpd::cli
