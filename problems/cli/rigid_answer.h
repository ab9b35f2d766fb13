// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "problems/cli/seeded_runs.h"

// Plans of a robot that turns, as phongpd plan writes them.
namespace phongpd::cli {

// Of a source whose robot turns: a row and a line a run, as of other scenes.
int AnswerRigidPlan(const SeededRunFlags& flags, const SceneSource& source);

}  // namespace phongpd::cli
