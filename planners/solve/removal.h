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
  // How far the part may be drawn in, user's unit, ≥ 0.  Parts are often drawn
  // to fit exactly: they touch as they lie, or overlap a little, and nothing
  // moves.  The part that is then planned for is Shrunk by this
  // (shrunk_solid.h); 0: the part as it is.
  double tolerance = 0.0;
  bool verifies = true;  // on the solids as well (verification.h)
  // Where no translation takes a part out, proved: for so many seconds, in
  // [0, 1e9], a way is looked for on which it turns as well (rigid_plan.h);
  // 0: it is not.
  double turn_seconds = 0.0;

  // Throws InputError naming the field.
  void Validate() const;
};

// How one part comes out of the others.
struct Removal {
  // kSolved: out, its box apart from theirs.  kInfeasibleProved: no translation
  // leads there, and turns were not asked for.  kTimeLimit: none does, proved,
  // and no way with turns was found in time, which proves nothing of these.
  // kStartInCollision: it is not free as it lies, within the tolerance, or too
  // close to others for turns to be judged.  kVerificationFailed,
  // kNotCertified, kFailed: a fault of ours, or no answer.
  PathStatus status = PathStatus::kFailed;
  std::string reason;  // one sentence unless it is out
  // By translation: of the part, from (0, 0, 0).  Empty where it turns.
  Path path;
  // With turns: the part's point p is at R (p − pivot) + q, with q and R of a
  // pose, first where it lies; from pose to pose it moves by RigidMotion about
  // the pivot, the middle of its box.  Every such motion is free for all t,
  // proved twice, of the vertices p − pivot as rounded.
  std::vector<RobotPose> poses;
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  // No translation takes it out, proved.
  bool needs_turns = false;
  double length = 0.0;  // user's unit; with turns in the object norm
  // Of all of the path, as it was planned for; with turns none is told: 0.
  double clearance = 0.0;
  // What was granted: every face of the part lies at least `granted_least`
  // below where it was drawn, and no vertex more than `granted_most` from
  // there; 0: nothing.
  double granted_least = 0.0, granted_most = 0.0;
  double seconds = 0.0;

  bool IsOut() const { return status == PathStatus::kSolved; }
};

// The way out of a part by translation alone: complete, so that without one
// there is a proof (kInfeasibleProved).  It ends beside the box of the rest, on
// the side that is nearest.  What turns take out, a bayonet or a hook, is
// looked for after that proof, if it is asked for.
//
//   Removal out = RemovePart(pin, {housing, lid}, {0.01});
//
// Throws InputError: bad options, no others, a part that does not stand being
// shrunk.
Removal RemovePart(const Solid& part, const std::vector<Solid>& rest,
                   const RemovalOptions& options = {});

// Which part comes out when.
struct Disassembly {
  struct Step {
    std::size_t part;  // its number in the list given
    Removal removal;   // out of those that are left
  };
  std::vector<Step> steps;  // in order; the last part left needs none
  // Of the parts that cannot be taken out, if any: why each of them does not
  // come out of the others of these.
  std::vector<Step> stuck;
  double seconds = 0.0;

  bool IsComplete() const { return stuck.empty(); }
  // Every part that is left is proved to be held by the others of them: no
  // order of single parts by translation does better.  (What is taken away
  // only gives room: trying whichever part comes out first loses nothing.)
  // Where turns were looked for in vain it is not.
  bool IsProved() const;
};

// An order in which all parts come out one by one; turns are looked for, part
// by part, only when no part is left that comes out without.  Throws like
// RemovePart, and for fewer than two parts.
Disassembly Disassemble(const std::vector<Solid>& parts,
                        const RemovalOptions& options = {});

}  // namespace phongpd
