// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "planners/trajectory/ipopt_solve.h"
#include "planners/trajectory/nonlinear_program.h"

namespace phongpd {

// A nonlinear program of your own for Ipopt: derive from this class and write
// four functions (and OnIterate if you need it).
//
//   min f(x)   subject to   low ≤ g(x) ≤ high
//
// x has no bounds, the Jacobian of g is dense, and there are no second
// derivatives.  This is for up to some hundred variables and rows; for larger
// programs derive from NonlinearProgram, which has sparsity patterns.  A
// function may return NaN or infinity where it has no value: the solver then
// takes a shorter step.  It fails if the start is such a point.
//
//   SolveWithIpopt(&program, start, DenseProgram::Settings());
//
// For rows of non-penetration see planners/world/non_penetration_rows.h.
class DenseProgram : public NonlinearProgram {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  // The number of variables, and the bounds of the rows; ±kNoBound or ±infinity
  // mean no bound.  Throws InputError unless variables ≥ 1, and both bounds
  // have one size with low ≤ high.
  DenseProgram(int variables, Vector low, Vector high);

  // The defaults of IpoptSettings, with a quasi-Newton approximation of the
  // Hessian (L-BFGS): use these, because a DenseProgram has no Hessian.
  static IpoptSettings Settings();

  virtual double Value(const Vector& x) const = 0;     // f
  virtual Vector Gradient(const Vector& x) const = 0;  // ∇f
  virtual Vector Rows(const Vector& x) const = 0;      // g
  virtual Matrix RowGradients(
      const Vector& x) const = 0;  // ∂g, rows × variables
  // Called when the solver accepts x as its new iterate
  // (NonlinearProgram::Accept).  Only here may the program change g, for
  // example the branch of a metric.
  virtual void OnIterate(const Vector& x);

  int variables() const final { return variables_; }
  int rows() const final { return static_cast<int>(low_.size()); }

 private:
  Vector At(const double* x) const {
    return Eigen::Map<const Vector>(x, variables_);
  }
  int jacobian_nonzeros() const final { return rows() * variables_; }
  int hessian_nonzeros() const final { return 0; }
  void Bounds(double* x_low, double* x_high, double* g_low,
              double* g_high) const final;
  void JacobianPattern(int* row, int* col) const final;
  void HessianPattern(int* row, int* col) const final;
  double Objective(const double* x) const final;
  void ObjectiveGradient(const double* x, double* gradient) const final;
  bool Constraints(const double* x, double* values, double* jacobian) final;
  void Hessian(const double* x, double objective_factor,
               const double* multipliers, double* values) const final;
  int Accept(const double* x) final;

  int variables_;
  Vector low_, high_;
};

}  // namespace phongpd
