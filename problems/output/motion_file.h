// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "constraints/free_space.h"
#include "constraints/trajectory.h"

// Motions in time as machines read them.
namespace phongpd {

// No more rows in a file of a motion.
inline constexpr double kMostTimedRows = 1e7;

// Throws InputError where a motion of so many seconds has more rows than that,
// `rate` a second.
void RequireFewRows(double seconds, double rate);

// "t,x,y,z,vx,vy,vz,ax,ay,az" at 0, 1/rate, 2/rate, ... and at the end; of an
// empty trajectory the names only.  Throws InputError for more than
// kMostTimedRows.
std::string TimedCsv(const Trajectory& trajectory, double rate);

// The same rows as trajectory_msgs/JointTrajectory of ROS 2, in YAML: three
// prismatic axes x, y and z, in metres; `unit` is the name of the trajectory's
// own.  Of one of several robots its name goes before those of its axes, with a
// low line, "left_x".  Throws InputError as above, and where the unit has no
// name.
std::string RosTrajectory(const Trajectory& trajectory, double rate,
                          const std::string& unit,
                          const std::string& robot = "");

// The same as trajectory_msgs/MultiDOFJointTrajectory: one body, by its name,
// that does not turn.
std::string RosMultiDofTrajectory(const Trajectory& trajectory, double rate,
                                  const std::string& unit,
                                  const std::string& robot = "robot");

// G-code in millimetres: a straight line G1 for each 0.05 s at most, with the
// mean speed along the curve as its feed, and G4 (seconds) where it rests.  The
// lines as they are written are within 0.01 mm of the curve, or less where it
// takes that for them to be free in `space`, which they are by the exact judge;
// the first comment tells both.  Nothing leads to the curve's beginning.  Of an
// empty trajectory a comment.  Throws InputError where the unit has no name,
// for more than kMostTimedRows lines, and where no lines are free.
std::string MotionGcode(const FreeSpace& space, const Trajectory& trajectory,
                        const std::string& unit);

// Throws InputError starting with `what` where the unit has no name.
void RequireUnit(const std::string& unit, const std::string& what);

}  // namespace phongpd
