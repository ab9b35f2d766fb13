// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "planners/trajectory/nonlinear_program.h"

namespace phongpd {

// `value`, the largest double in place of NaN and beyond ±that: no NaN leaves
// a solve.
double Finite(double value);

// A program with its bounds, and with values and Jacobian of the last point
// asked for: both come from one evaluation, and a solver asks for them one
// after the other.  They are remembered by the bytes of x.
class EvaluatedProgram {
 public:
  // The program must outlive this.
  explicit EvaluatedProgram(NonlinearProgram* program);

  // False where the program has no values.  Forgets every other point.
  bool Evaluate(const double* x);

  // Of the last point, if Evaluate returned true.
  const Eigen::VectorXd& values() const { return values_; }
  const Eigen::VectorXd& jacobian() const { return jacobian_; }

  // Both finite.  Violation is the largest of a row or bound, evaluates x, and
  // is the largest double where there are no values.
  double Objective(const double* x) const;
  double Violation(const double* x);

 private:
  bool IsAt(const double* x) const;

  NonlinearProgram& program_;
  Eigen::VectorXd at_, values_, jacobian_;
  bool is_at_valid_ = false;
  Eigen::VectorXd x_low_, x_high_, g_low_, g_high_;
};

}  // namespace phongpd
