// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "problems/cli/optimize_flags.h"
#include "problems/cli/seeded_runs.h"

// Paths of a robot that turns, as phongpd plan and optimize write them.
namespace phongpd::cli {

// Of a source whose robot turns: a row and a line a run, as of other scenes.
int AnswerRigidPlan(const SeededRunFlags& flags, const SceneSource& source);
int AnswerRigidOptimize(const OptimizeFlags& flags, const SceneSource& source);

}  // namespace phongpd::cli
