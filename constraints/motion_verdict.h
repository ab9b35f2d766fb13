// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd {

// Is a motion free?  The answer of all judges: of curves, among obstacles that
// move, and of robots that turn.
enum class MotionVerdict {
  kFree,       // all the way: proved
  kCollides,   // at the time that is told: proved
  kUndecided,  // closer to contact than the judge can tell: not free
};

const char* ToString(MotionVerdict verdict);  // free, collides, undecided

}  // namespace phongpd
