// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <vector>

#include "planners/rigid/rigid_links.h"

namespace phongpd::internal {

// Cuts a path of free motions short in the object norm, its ends kept: poses it
// can do without go, far ones first; then straight motions between random
// places of the path replace what is between, as long as that succeeds now and
// then, and until the judge has looked at `max_tests` pairs, which the last cut
// may go beyond.  Every motion of the result is proved free.  Ends early when
// the search is stopped, with what it has.
void ShortenRigidPath(double gyration, long max_tests, RigidLinks* links,
                      std::mt19937_64* random, std::vector<RobotPose>* path);

}  // namespace phongpd::internal
