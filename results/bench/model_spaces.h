// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "results/bench/motion_cases.h"

namespace phongpd::bench {

// Robots of a fifth of the size in closed meshes that others made: OFF files
// of CGAL's demos in `folder` (scripts/models.sh), scans and parts.  Pairs
// whose files are not there are left out, and the files named in *missing.
// Throws InputError for a file that is no solid.
std::vector<MotionSpace> ModelSpaces(const std::string& folder,
                                     std::vector<std::string>* missing);

}  // namespace phongpd::bench
