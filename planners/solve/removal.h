// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "core/contact/depth.h"
#include "core/solid/solid.h"
#include "planners/solve/path_answer.h"

namespace phongpd {

struct RemovalOptions {
  // How much the part may be shrunk (shrunk_solid.h), user's unit, ≥ 0; 0: not
  // at all.  Parts are often drawn to fit exactly: they touch where they lie,
  // or overlap a little, and then nothing can move.
  double tolerance = 0.0;
  bool verifies = true;  // also on the original solids (verification.h)
  // If it is proved that no translation takes a part out, search for a path
  // with turns (rigid_plan.h) for at most so many seconds, in [0, 1e9]; 0: do
  // not search.
  double turn_seconds = 0.0;

  // Throws InputError naming the field.
  void Validate() const;
};

// How one part comes out of the others.
struct Removal {
  // kSolved: the part is out; its bounding box is apart from that of the
  // others.
  // kInfeasibleProved: no translation takes it out, and turns were not asked
  // for.
  // kTimeLimit: no translation does, proved, and no path with turns was found
  // in time; this does not prove that there is none.
  // kStartInCollision: it collides where it lies, even when shrunk by the
  // tolerance; or it is too close to the others to judge turns.
  // kVerificationFailed, kNotCertified, kFailed: a fault of ours, or no answer.
  PathStatus status = PathStatus::kFailed;
  std::string reason;  // one sentence unless it is out
  // A path by translation: displacements of the part, the first (0, 0, 0).
  // Empty if it turns.
  Path path;
  // A path with turns: at a pose (q, R), the point p of the part is at
  // R (p − pivot) + q.  The pivot is the middle of the part's box, and the
  // first pose is where the part lies.  From pose to pose it moves by
  // RigidMotion about the pivot.  Every such motion is proved free for all t,
  // twice, with the rounded vertices p − pivot.
  std::vector<RobotPose> poses;
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  // It is proved that no translation takes the part out.
  bool needs_turns = false;
  double length = 0.0;  // user's unit; with turns in the object norm
  // Least clearance of the (shrunk) part on the path; 0 with turns: not known.
  double clearance = 0.0;
  // How much the part was shrunk: every face lies at least `granted_least`
  // below where it was drawn, and no vertex is more than `granted_most` from
  // where it was; 0: not at all.
  double granted_least = 0.0, granted_most = 0.0;
  double seconds = 0.0;  // wall time

  bool IsOut() const { return status == PathStatus::kSolved; }
};

// Takes one part out of an assembly: a path from where it lies to a place
// beside the bounding box of `rest`, and of the paths to its sides the shortest
// found.  The search among translations is complete: without a path, there is a
// proof that none exists (kInfeasibleProved).  If turn_seconds > 0, a path with
// turns is searched for after that proof: for a bayonet or a hook, say.
//
//   Removal out = RemovePart(pin, {housing, lid}, {0.01});
//
// Throws InputError for bad options, for an empty `rest`, and for a part that
// cannot be shrunk by the tolerance.
Removal RemovePart(const Solid& part, const std::vector<Solid>& rest,
                   const RemovalOptions& options = {});

// An order of removals.
struct Disassembly {
  struct Step {
    std::size_t part;  // index in the list given
    Removal removal;   // out of the parts that are left
  };
  // In order.  The last part needs no step.
  std::vector<Step> steps;
  // The parts that could not be taken out, if any, each with the reason why it
  // does not come out of the others in this list.
  std::vector<Step> stuck;
  double seconds = 0.0;  // wall time

  bool IsComplete() const { return stuck.empty(); }
  // Is each stuck part proved to be held by the other stuck parts?  Then no
  // order of translations, one part at a time, takes out more.  (It does not
  // matter which part comes out first: a part that is gone only leaves more
  // room.)  False if turns were searched for and not found.
  bool IsProved() const;
};

// Takes all parts out one by one.  Turns are searched for only when no part is
// left that comes out by translation.  Throws like RemovePart, and for fewer
// than two parts.
Disassembly Disassemble(const std::vector<Solid>& parts,
                        const RemovalOptions& options = {});

}  // namespace phongpd
