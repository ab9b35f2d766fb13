// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "planners/solve/fleet.h"
#include "planners/solve/optimize.h"
#include "viewer/view.h"

namespace phongpd {

// A certified motion to be played in its own time, with what it asks of the
// limits of the request, and the room it has from what is fixed and what moves;
// without one what there is, the path it began with.
NamedPath PathInTime(const World& world, const OptimizeRequest& request,
                     const PathAnswer& answer);

// Obstacles that move, from the time 0 on for `seconds`, or until the last has
// come to rest for 0.
std::vector<ViewMover> MoversOf(const std::vector<MovingObstacle>& moving,
                                double seconds);

// In a FleetSceneView of them: motions of several robots, all for the time that
// the last one takes, each with its own solid and the room that it has from all
// others; what else moves; and who comes closest to whom, in a note.  Where
// there are no motions of all, the paths that were found.
void AddFleet(const std::vector<FleetRobot>& robots, const FleetAnswer& answer,
              View* view);

// "a and b, 12 mm at t = 1.2 s", of a pair; unit: of its lengths.
std::string ClosestText(const FleetPair& pair, const std::string& unit);

}  // namespace phongpd
