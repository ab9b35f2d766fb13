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

// What Plan is asked: a path of poses from start to goal.
struct RigidRequest {
  RobotPose start, goal;
  // Where the robot's origin may be, user's unit.  Empty, the default: the box
  // of the obstacles, start and goal, grown on all sides by twice the robot's
  // reach, the distance of its farthest corner from its origin.
  Eigen::AlignedBox3d bounds{};
  double time_limit = 10.0;  // seconds of wall time, in (0, 1e9]
  std::uint64_t seed = 1;    // of all random numbers
  // So many searches race, each on a thread and with random numbers of its own;
  // in [1, 64].  On fewer processors than threads each search takes as
  // much longer.
  int threads = 2;
  // Called in the caller's thread only, before each motion that it judges and
  // every few milliseconds while it waits for other threads; returning true
  // stops the planner, as the time limit does.
  std::function<bool()> is_interrupted{};
  // Shorten the path?  As found it has hundreds of poses; shortening takes
  // short cuts and leaves out the poses that are not needed.
  bool shortens = true;

  // Throws InputError naming the field.
  void Validate() const;
};

// What Plan answers.  No member is NaN or infinite.
struct RigidAnswer {
  // kSolved: there is a path.
  // kStartInCollision, kGoalInCollision: also if this could not be decided.
  // kStartOutOfBounds, kGoalOutOfBounds.
  // kTimeLimit, kInterrupted: no path was found until then.
  // kNotCertified: the judge's second pass refused the path, a fault of ours.
  // Never kInfeasibleProved: that no path was found proves nothing.
  PathStatus status = PathStatus::kFailed;
  std::string reason;  // one sentence if there is no path
  // From the request's start to its goal, both bit for bit; empty: no path.
  // Between two poses the robot moves by RigidMotion.  Every such motion is
  // proved free for all t, twice: when it was found, and again at the end.
  std::vector<RobotPose> path;
  double length = 0.0;  // of the path, object norm (rigid_world.h), user's unit
  // The smallest distance from the obstacles along the path, proved, and where:
  // to a thousandth, or as is_resolved says.  All zero without a path.
  RigidClearance clearance;
  std::string planner;   // "line", "straight", "slide" or "tow"; "" if none
  double seconds = 0.0;  // wall time of the whole call
  double search_seconds = 0.0;  // of that, until a path was found or given up
  // The same in processor seconds of the process, all its threads: with two
  // threads up to twice as much.
  double search_cpu_seconds = 0.0;
  // Counts are of the thread whose path it is, as if there were no others,
  // which are stopped wherever they are; without a path, of all threads.
  long checks = 0;              // motions judged
  long tests = 0;               // pairs of boxes and of triangles tested
  long search_tests = 0;        // of these, until a path was found or given up
  long nodes = 0;               // poses in all trees
  std::size_t found_poses = 0;  // in the path before it was shortened
  // If the start or goal is in collision: which triangles intersect, or could
  // not be separated (rigid_judge.h).
  RigidCheck collision;
  // The penetration depth of those two meshes, user's unit; none unless both
  // are solids and it took less than a second.
  std::optional<double> depth;

  bool IsSolved() const { return status == PathStatus::kSolved; }
};

// Plans a path for a robot that translates and turns (SE(3)).  For one that
// only translates use the Plan of planners/solve/plan.h, which is complete.
//
// The motion straight to the goal is tried first ("line").  If it collides,
// three planners with two random trees each, one from the start and one from
// the goal, take turns, so that straight does a fifth of the work, slide a
// third and tow the rest:
//   straight  adds straight motions as far as they are free; best in worlds
//             with much room; it has a head start of about half a second
//   slide     slides along contacts (rigid_slide.h) towards random poses, and
//             towards poses in which edges or faces of the robot are parallel
//             to those of the obstacles
//   tow       like slide, but a third of its slides pull only one corner of the
//             robot to a place, and let the robot turn as it must
// That race is run on each thread with a seed of its own, the request's in the
// caller's thread.  The path that took its thread the least work wins, work
// being counted, not timed: once there is one, the other threads go on until
// they have one for less, or have worked as much.  It is shortened, by no more
// work than finding it took, but for some milliseconds, and each of its motions
// is judged again.
//
// The same request in the same world gives the same path on the same machine,
// however busy that is, unless time runs out or the caller interrupts: all
// random numbers come from the seed, and the answer is that of one thread with
// the winner's seed.  If time runs out when one thread has a path and others
// have not yet worked as much, that path is the answer.
//
// Throws InputError for bad requests, and std::system_error if a thread cannot
// be started.  Thread-safe; runs in the caller's thread and, unless the
// straight motion is free, in `threads` − 1 others that have ended when it
// returns. Memory grows by tens of MB in a minute, for each thread.
RigidAnswer Plan(const RigidWorld& world, const RigidRequest& request);

// The same for a robot that translates and keeps its orientation bit for bit,
// which start and goal have alike.  Straight and slide search, without aligned
// features.  For surfaces that bound no solid, where nothing can be built, and
// for pages; among solids the Plan of planners/solve/plan.h is complete, and
// proves that there is no path.  Throws InputError for a goal that is turned
// otherwise, too.
RigidAnswer PlanWithoutTurning(const RigidWorld& world,
                               const RigidRequest& request);

}  // namespace phongpd
