// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "planners/solve/optimize.h"
#include "problems/cli/optimize_flags.h"
#include "problems/scenes/scene.h"

// What users of phongpd optimize ask of the library.
namespace phongpd::cli {

// Writes over the scene's settings what the flags say otherwise.  Throws
// InputError naming a flag.
void OverrideScene(const OptimizeFlags& flags, Scene* scene);

// The request for a path without time in that scene; a flag holds before a
// preset, and both before what the library does by itself.  Throws InputError
// naming a flag.
OptimizeRequest PathRequestOf(const OptimizeFlags& flags, const Scene& scene,
                              std::uint64_t seed);

}  // namespace phongpd::cli
