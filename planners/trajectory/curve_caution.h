// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace phongpd::internal {

// With which pieces of a curve the program of a round is trusted less.
//
// A curve goes at the pace of its worst piece: one where the program's first
// order fails costs all the others their gain, and of many pieces there nearly
// always is one.  What fails are products of what durations change by from
// piece to piece and of what points do.  So there, and not everywhere, such
// changes of durations cost more.
class CurveCaution {
 public:
  // Of each piece, in (0, 1], how far it is trusted; empty, as at the
  // beginning: 1.
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
