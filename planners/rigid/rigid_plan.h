// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planners/rigid/rigid_world.h"
#include "planners/world/path_status.h"

namespace phongpd {

// A path of poses from start to goal.
struct RigidRequest {
  RobotPose start, goal;
  // Of the robot's origin.  As made: the box of the obstacles, start and
  // goal, grown on all sides by twice the robot's reach from its origin.
  Eigen::AlignedBox3d bounds{};
  double time_limit = 10.0;  // seconds of wall time, in (0, 1e9]
  std::uint64_t seed = 1;
  // Asked before every motion that is judged; true ends it as time does.
  std::function<bool()> is_interrupted{};
  // Paths as found have hundreds of poses; shortened they are cut across and
  // lose what they can do without.
  bool shortens = true;

  // Throws InputError naming the field.
  void Validate() const;
};

// What Plan answers.  No member is NaN or infinite.
struct RigidAnswer {
  // kSolved; kStartInCollision (undecided counts as collision) or
  // kStartOutOfBounds, the same of the goal; kTimeLimit and kInterrupted: none
  // was found until then; kNotCertified: the second pass of the judge did not
  // confirm the path, which is a fault of ours.  Never kInfeasibleProved: not
  // to find a path proves nothing.
  PathStatus status = PathStatus::kFailed;
  std::string reason;  // one sentence where there is no path
  // From the request's start to its goal, both bit for bit; between two poses
  // the robot moves by RigidMotion.  Every such motion is free for all t,
  // proved twice: when it was found and when all was done.  Empty: none.
  std::vector<RobotPose> path;
  double length = 0.0;  // of the path, object norm; user's unit
  // How close it comes to the obstacles, proved, and where: to a thousandth of
  // it, or as is_resolved says.  Of no path all 0.
  RigidClearance clearance;
  std::string planner;   // "line", "straight", "slide" or "tow"; empty: none
  double seconds = 0.0;  // wall time of all
  double search_seconds = 0.0;  // until a path was found, or none
  // The same in processor seconds of the process, all its threads.
  double search_cpu_seconds = 0.0;
  long checks = 0;        // motions judged
  long tests = 0;         // pairs of boxes and triangles the judge looked at
  long search_tests = 0;  // those until a path was found, or none
  long nodes = 0;         // poses of all trees
  std::size_t found_poses = 0;  // of the path before it was shortened
  // Of a start or goal in collision: who meets whom, or is not told apart
  // (rigid_judge.h), and how deep these two meshes are in each other, where
  // both are solids and that is known within a second.
  RigidCheck collision;
  std::optional<double> depth;

  bool IsSolved() const { return status == PathStatus::kSolved; }
};

// Plans for a robot that turns.  First the motion straight to the goal; then
// three bidirectional trees race, taking turns by the work they have done:
//   straight  grows by straight steps as long as they are free, for worlds with
//             much room; it has a head start of about half a second;
//   slide     grows along contacts (rigid_slide.h), to random poses and to such
//             as have edges and faces of robot and obstacles parallel;
//   tow       as slide, but half of its slides pull a corner of the robot to a
//             place and let it turn as it has to.
// What is found is shortened, by no more work than finding it was but for some
// milliseconds, and judged again, motion by motion.
//
// The same request in the same world gives the same path on the same machine,
// unless time runs out; random numbers come from the seed alone.
//
// Throws InputError for bad requests.  Thread-safe; runs in the caller's
// thread.  Memory grows with time, by tens of MB a minute.
RigidAnswer Plan(const RigidWorld& world, const RigidRequest& request);

}  // namespace phongpd
