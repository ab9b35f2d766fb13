// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "planners/trajectory/ipopt_solve.h"
#include "planners/trajectory/nonlinear_program.h"

namespace phongpd {

// A program of one's own in four functions, five with OnIterate:
//
//   min f(x)   subject to   low ≤ g(x) ≤ high,
//
// x free, with a dense Jacobian and no second derivatives: for some hundred
// variables and rows.  Larger ones are NonlinearPrograms with patterns.
// Where a function has no value it may answer NaN or infinity: the solver then
// takes a shorter step, and fails if it starts there.
//
//   SolveWithIpopt(&program, x, DenseProgram::Settings());
class DenseProgram : public NonlinearProgram {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  // Bounds of the rows; ±kNoBound and infinities are none.  Throws InputError
  // unless there is a variable and the bounds are of one size, low ≤ high.
  DenseProgram(int variables, Vector low, Vector high);

  // Ipopt's defaults with a quasi-Newton Hessian, which this needs.
  static IpoptSettings Settings();

  virtual double Value(const Vector& x) const = 0;     // f
  virtual Vector Gradient(const Vector& x) const = 0;  // ∇f
  virtual Vector Rows(const Vector& x) const = 0;      // g
  virtual Matrix RowGradients(
      const Vector& x) const = 0;  // ∂g, rows × variables
  // x is the solver's new iterate: what branches follow (NonlinearProgram's
  // Accept).
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
