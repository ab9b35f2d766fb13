// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/motion_verdict.h"

namespace phongpd {

const char* ToString(MotionVerdict verdict) {
  switch (verdict) {
    case MotionVerdict::kFree:
      return "free";
    case MotionVerdict::kCollides:
      return "collides";
    case MotionVerdict::kUndecided:
      return "undecided";
  }
  return "unknown";
}

}  // namespace phongpd
