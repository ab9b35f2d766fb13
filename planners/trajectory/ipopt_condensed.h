// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd {

// Ipopt's linear solver for programs whose rows are all inequalities:
// CondensedSystem in the place of a general one.  Where Ipopt takes solvers by
// functions it calls (its HSLLoader.h, up to 3.13) this hands it ours under the
// name it knows, ma27, while an object of this class lives; at most one at a
// time (SolveWithIpopt's lock).
class CondensedSolver {
 public:
  // False where Ipopt takes no solver by functions, or the process has loaded
  // the real one of that name.
  static bool IsAvailable();
  // What to give Ipopt's option linear_solver.
  static const char* Name() { return "ma27"; }

  // `rows` of the program; IsAvailable.
  explicit CondensedSolver(int rows);
  ~CondensedSolver();
  CondensedSolver(const CondensedSolver&) = delete;
  CondensedSolver& operator=(const CondensedSolver&) = delete;
};

}  // namespace phongpd
