// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace phongpd::internal {

// With which pieces of a curve the program of a round is trusted less.
//
// A curve goes at the pace of its worst piece: one where the program's first
// order fails costs all the others their gain, and of many pieces there nearly
// always is one.  What fails is the product of the changes of a duration and of
// the points, which falls with the duration's.  So there, and not everywhere,
// durations may change less.
class CurveCaution {
 public:
  // Of each piece the share of σ by which ln h may change, in (0, 1]; empty, as
  // at the beginning: 1.
  const std::vector<double>& shares() const { return shares_; }

  // What a whole step teaches, that was `predicted` to gain a share > 0 of the
  // time: the factors by which each piece would have to be slowed after it,
  // 1 being what the program said.  Are few of them to blame for what the step
  // falls short of?
  bool Learn(const std::vector<double>& slowings, double predicted);

  // Each piece is two from now on.
  void Halve();

 private:
  std::vector<double> shares_;
};

}  // namespace phongpd::internal
