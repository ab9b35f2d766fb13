// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "results/bench/motion_cases.h"

namespace phongpd::bench {

// The least number of jumps that any rule could have whose depth is at most c
// times the Euclidean one, whatever it is and though it knew the motion.
//
// At frame t such a rule has its contact in
//
//   S_t = {x ∈ C_cont : |x − q_t| ≤ c·d_t},   d the Euclidean depth,
//
// in one of the pieces that S_t consists of.  It gets from a piece to one of
// the next frame without a jump only if they come within a jump's length of
// each other.  The set of pieces that can be had without a jump is carried from
// frame to frame; when it dies, that is one jump of every rule, and all pieces
// can be had again.  Counting them as late as possible is least.
//
// All that is rounded is rounded in favour of rules, so that the count stays a
// lower bound: pieces are made of whole triangles, of edges up to 4 % of D, and
// reach 2.5 steps of the robot farther.
class Yardstick {
 public:
  explicit Yardstick(const ContactSpace& contact);
  ~Yardstick();

  // For each c, over the frames of one motion with those Euclidean depths.
  std::vector<int> LeastJumps(const Motion& motion,
                              const std::vector<double>& depths,
                              const std::vector<double>& ratios) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd::bench
