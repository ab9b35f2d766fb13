// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planners/solve/optimize.h"

// Optimize with limits, and Retime, but for the second judge.
namespace phongpd::internal {

// request.margin, or its default.

// Of a request with limits; not validated.  Throws InputError without.
CurveOptions CurveOptionsOf(const World& world, const OptimizeRequest& request);

// Of a request with limits.  Throws InputError for bad ones, and where all
// places are the same, before anything is built.
void OptimizeInTime(const World& world, const OptimizeRequest& request,
                    PathAnswer* answer);
void RetimePath(const World& world, const Path& path,
                const OptimizeRequest& request, PathAnswer* answer);

}  // namespace phongpd::internal
