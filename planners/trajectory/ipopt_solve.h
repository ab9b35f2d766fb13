// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "planners/trajectory/nonlinear_program.h"
#include "planners/world/ipopt_value.h"

namespace phongpd {

enum class SolveStatus {
  kConverged,        // to the tolerance
  kAcceptable,       // to Ipopt's acceptable level
  kStalledFeasible,  // feasible, no longer improving; NOT proved optimal
  kInfeasible,       // converged to a point of local infeasibility
  kIterationLimit,
  kTimeLimit,
  kCancelled,
  kNumerical,  // restoration or step computation failed, diverged, …
  kInvalidProblem,
  kInvalidStart,  // of a trajectory: not free
  kInvalidGoal,
};

// "converged", "stalled_feasible", …
const char* ToString(SolveStatus status);

// The solver may claim a solution: the first three.
bool IsClassOk(SolveStatus status);

// One accepted iterate.
struct IterationRecord {
  int iteration = 0;       // counts restoration iterations, too
  double objective = 0.0;  // of the program, also during restoration
  double violation = 0.0;  // largest of all rows, units of the rows
  double dual_infeasibility = 0.0;
  double mu = 0.0;
  bool is_restoration = false;
  int branch_changes = 0;  // NonlinearProgram::Accept
};

// Largest violation of a row with which an iterate counts as feasible.
inline constexpr double kFeasibility = 1e-6;

struct IpoptSettings {
  enum class MuStrategy { kAdaptive, kMonotone };

  int max_iterations = 200;  // ≥ 0
  MuStrategy mu_strategy = MuStrategy::kAdaptive;
  // Stop after this many iterations in which the best feasible iterate (no row
  // violated by more than kFeasibility) gained less than a thousandth of its
  // objective, and return it.  0: never.
  int stall_iterations = 30;
  double time_limit = std::numeric_limits<double>::infinity();  // seconds
  // Ipopt's own options; they win over the above and over a `tol` of 1e-6.
  // They may come from a stranger's scene: only those that change numbers are
  // taken.  Any other, and a name or value Ipopt does not know, is an
  // InputError that names it.
  IpoptValues ipopt_options;
  // The file that gets what Ipopt prints at its level 5; empty: none.
  std::string print_file;
  // Called once an iteration, with the iterate's variables; false ends the
  // solve (kCancelled).  It may not solve; what it throws ends the solve and
  // reaches its caller.  The first regular iterate after a restoration comes
  // again, under the number of the restoration's last one.
  std::function<bool(const IterationRecord&, const Eigen::VectorXd&)>
      on_iteration;

  // Throws InputError naming the field.
  void Validate() const;
};

struct EvaluationCounts {
  int objective = 0, gradient = 0, constraints = 0, jacobian = 0, hessian = 0;
};

// No member is NaN or infinite.
struct IpoptRun {
  SolveStatus status = SolveStatus::kInvalidProblem;
  std::string raw_status;  // Ipopt's own name, "Solve_Succeeded"
  // The solution where the status is ok; otherwise the best feasible iterate,
  // and the last iterate if there is none.
  Eigen::VectorXd x;
  bool is_feasible = false;          // x, to kFeasibility
  double objective = 0.0;            // at x
  double violation = 0.0;            // at x
  double dual_infeasibility = -1.0;  // of the last iterate; −1: not known
  int iterations = 0;
  int restoration_iterations = 0;
  EvaluationCounts evaluations;  // as Ipopt asked for them
  double seconds_callbacks = 0.0;
  double seconds_total = 0.0;
  std::vector<IterationRecord> log;
};

// "3.11.9": what the library was built with.
const char* IpoptVersion();

// Throws InputError for ipopt_options that SolveWithIpopt would refuse.
void CheckIpoptOptions(const IpoptSettings& settings);

// Runs Ipopt from `start`, with MUMPS or, where all rows are inequalities and
// the settings name no linear_solver, the condensed system (ipopt_condensed.h):
// the same steps in a fraction of the time.  Values and Jacobian come from one
// evaluation and are remembered by the bytes of x, since Ipopt's new_x tells
// tags apart, not points.  Silent, reads no option file, same input same
// bytes.  Two solves at the same time in one process are not safe, so a mutex
// lets them in one by one: use processes to go parallel. Throws InputError for
// bad settings or a start that is not finite or has the wrong size, and
// BuildCancelled at the next iteration after CancelBuilds (build_stop.h).
IpoptRun SolveWithIpopt(NonlinearProgram* program, const Eigen::VectorXd& start,
                        const IpoptSettings& settings);

}  // namespace phongpd
