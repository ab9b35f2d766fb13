// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "constraints/non_penetration.h"
#include "planners/trajectory/nonlinear_program.h"
#include "planners/trajectory/path_springs.h"
#include "planners/trajectory/trajectory_problem.h"

namespace phongpd {

// A TrajectoryProblem as a nonlinear program in u, waypoint = centre + D·u with
// the centre half way between start and goal.  Rows, in this order: those of
// NonPenetrationConstraint (units of D), then |u_{i+1} − u_i|²/η ≤ η for the
// N+1 segments, η = h/D.  The Hessian holds the objective and the length rows
// exactly, and nothing of the contact rows.
class TrajectoryNlp : public NonlinearProgram {
 public:
  // `samples`: one count per segment; `start_length` decides h; `rows`: K of
  // NonPenetrationConstraint.
  TrajectoryNlp(const TrajectoryProblem& problem,
                const std::vector<int>& samples, double start_length, int rows);

  Eigen::VectorXd ToVariables(const Path& path) const;
  // The ends are exactly start and goal.
  Path ToPath(const Eigen::VectorXd& u) const;
  // Chooses cold branches at u; before a solve.
  void Start(const Eigen::VectorXd& u);

  const NonPenetrationConstraint& contact() const { return contact_; }
  const NonPenetrationCounts& counts() const { return counts_; }

  int variables() const override { return 3 * springs_.waypoints; }
  int rows() const override { return contact_.rows() + springs_.rows(); }
  int jacobian_nonzeros() const override {
    return contact_.nonzeros() + springs_.jacobian_nonzeros();
  }
  int hessian_nonzeros() const override { return springs_.hessian_nonzeros(); }
  void Bounds(double* x_low, double* x_high, double* g_low,
              double* g_high) const override;
  void JacobianPattern(int* row, int* col) const override;
  void HessianPattern(int* row, int* col) const override;
  double Objective(const double* x) const override;
  void ObjectiveGradient(const double* x, double* gradient) const override;
  bool Constraints(const double* x, double* values, double* jacobian) override;
  void Hessian(const double* x, double objective_factor,
               const double* multipliers, double* values) const override;
  int Accept(const double* x) override;

 private:
  Eigen::Vector3d start_, goal_;  // user's unit
  double margin_ = 0.0;           // units of D
  PathSprings springs_;
  BoundingBox bounds_;
  NonPenetrationConstraint contact_;
  BranchSet branches_;
  // What they become if the last point evaluated is accepted.
  BranchSet next_;
  Eigen::VectorXd next_at_;  // empty: none
  NonPenetrationCounts counts_;
};

}  // namespace phongpd
