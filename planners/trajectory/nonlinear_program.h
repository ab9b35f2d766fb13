// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd {

// A bound that is none: Ipopt's infinity is 1e19.
inline constexpr double kNoBound = 2e19;

// A nonlinear program as a solver sees it, sparse and with fixed patterns:
//
//   min f(x)   subject to   x_low ≤ x ≤ x_high,  g_low ≤ g(x) ≤ g_high.
//
// Bounds of ±kNoBound mean none.  Patterns are zero-based; the Hessian's holds
// the lower triangle.  An implementation may keep a state that changes g (the
// branches of a metric), but only in Accept.
class NonlinearProgram {
 public:
  virtual ~NonlinearProgram() = default;

  virtual int variables() const = 0;
  virtual int rows() const = 0;
  virtual int jacobian_nonzeros() const = 0;
  virtual int hessian_nonzeros() const = 0;
  virtual void Bounds(double* x_low, double* x_high, double* g_low,
                      double* g_high) const = 0;
  virtual void JacobianPattern(int* row, int* col) const = 0;
  virtual void HessianPattern(int* row, int* col) const = 0;

  virtual double Objective(const double* x) const = 0;
  virtual void ObjectiveGradient(const double* x, double* gradient) const = 0;
  // Values and Jacobian from one evaluation; false where there is none.
  virtual bool Constraints(const double* x, double* values,
                           double* jacobian) = 0;
  // Σ of objective_factor ∇²f and multipliers[i] ∇²g_i.
  virtual void Hessian(const double* x, double objective_factor,
                       const double* multipliers, double* values) const = 0;

  // The solver made x its iterate.  Called once for each iterate that differs
  // from the one before, never with a rejected trial point.  Returns the number
  // of discrete changes (of branch) this brought, for the log.
  virtual int Accept(const double* /*x*/) { return 0; }
};

}  // namespace phongpd
