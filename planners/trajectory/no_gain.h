// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "planners/trajectory/ipopt_solve.h"

namespace phongpd {

// Stops a search that is about to end no better than a path in hand: once four
// iterates in a row are nearly feasible (1e-3 of D) and the objective, less ten
// times the largest of its last three losses, is above what would be worth it.
// A forecast, no bound: of 345 second searches of 20 scene families it stops a
// quarter of the iterations, and none that would have gained 0.5 %.
class NoGain {
 public:
  // Worth it: less than (1 − worthwhile) · best.
  NoGain(double best, double worthwhile) : limit_((1.0 - worthwhile) * best) {}

  // Makes the settings tell this of every iterate and cancel by it, besides
  // what they do already.  Must outlive the solve.
  void Stop(IpoptSettings* settings);

  bool has_ended() const { return has_ended_; }

 private:
  void See(const IterationRecord& record);

  double limit_;
  int feasible_ = 0;  // iterates in a row
  double last_ = 0.0;
  std::array<double, 3> losses_ = {};
  bool has_ended_ = false;
};

}  // namespace phongpd
