// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "planners/world/workspace.h"

namespace phongpd {

// Whether a configuration q is free, and if not, why: from the solids
// themselves, with no contact space and no resolution.
struct Diagnosis {
  // An obstacle B that the robot at q meets; solids that touch meet.
  struct Contact {
    int obstacle = -1;  // index in the workspace
    std::string name;   // its id
    // Proved: after a translation of this length along the unit vector
    // `direction` robot and obstacle have no inner point in common.  Rounded;
    // 0: they only touch.
    double depth_at_most = 0.0;
    Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  };
  // A bound that q does not keep.
  struct Excess {
    int axis = 0;  // of x, y, z
    bool is_maximum = false;
    double bound = 0.0;
    double by = 0.0;  // user's unit, ≥ 0; 0: q lies on it
  };

  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  std::vector<Contact> contacts;  // in the order of the obstacles
  std::vector<Excess> excesses;

  bool IsFree() const { return contacts.empty() && excesses.empty(); }
  bool IsOnlyOutOfBounds() const {
    return contacts.empty() && !excesses.empty();
  }

  // One sentence that calls q `which`, "goal (5,0,0) is not strictly within
  // the bounds: x is 3 above the maximum 2"; depths are rounded up.  Empty
  // where q is free.
  std::string Text(const std::string& which) const;
};

// Exact but for the depths (depth_bound.h): robot + q against each obstacle by
// MotionOracle, q against the open box of the bounds.  Milliseconds for tens
// of thousands of triangles; obstacles whose box the robot's does not meet
// cost nothing.  Throws InputError if q is not finite.  Thread-safe.
Diagnosis Diagnose(const Workspace& workspace, const Eigen::Vector3d& q);

// One sentence for a q that is free of the solids but not of their contact
// space, because it is within the rounding of the latter.
std::string BlockedByRounding(const Eigen::Vector3d& q,
                              const std::string& which);

}  // namespace phongpd
