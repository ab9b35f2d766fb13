// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

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

  // Throws InputError naming the field.
  void Validate() const;
};

// How one part comes out of the others.
struct Removal {
  // kSolved: out, its box apart from theirs.  kInfeasibleProved: no translation
  // leads there.  kStartInCollision: it is not free as it lies, within the
  // tolerance.  kVerificationFailed, kFailed: a fault of ours, or no answer.
  PathStatus status = PathStatus::kFailed;
  std::string reason;      // one sentence unless it is out
  Path path;               // of the part, from (0, 0, 0)
  double length = 0.0;     // user's unit
  double clearance = 0.0;  // of all of the path, as it was planned for
  // What was granted: every face of the part lies at least `granted_least`
  // below where it was drawn, and no vertex more than `granted_most` from
  // there; 0: nothing.
  double granted_least = 0.0, granted_most = 0.0;
  double seconds = 0.0;

  bool IsOut() const { return status == PathStatus::kSolved; }
};

// The way out of a part by translation alone: complete, so that without one
// there is a proof (kInfeasibleProved).  It ends beside the box of the rest, on
// the side that is nearest.
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
  bool IsProved() const;
};

// An order in which all parts come out one by one.  Throws like RemovePart,
// and for fewer than two parts.
Disassembly Disassemble(const std::vector<Solid>& parts,
                        const RemovalOptions& options = {});

}  // namespace phongpd
