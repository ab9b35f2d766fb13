// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "planners/rigid/optimizer/pose_chart.h"
#include "planners/rigid/pose_contacts.h"
#include "planners/trajectory/nonlinear_program.h"

namespace phongpd::internal {

// A place of a path, at t of a link, and what it is close to.
struct PathContacts {
  int link = 0;
  double t = 0.0;
  std::vector<PoseContact> contacts;
};

// The step of the knots of a path that shortens it most, to first order among
// what it is close to: in the numbers x of a PoseChart around it, with a share
// s in [0, 1] for each place that lacks c = (margin − least gap)/U > 0,
//
//   min ½ Σ |D_i + x_i+1 − x_i|²/w_i + Σ P c (1 − s)   subject to
//   gap + n · v + (r × n) · ω ≥ min(margin, gap + s (margin − gap)),
//   |x_k| ≤ trust/U
//
// D_i = d_i/U the links, w_i = |D_i| or a twentieth of their mean, (v, ω) how
// the place moves with the knots, P = kPenalty.  With these weights the first
// sum at x = 0 is half of the length, and elsewhere bounds it, so what it loses
// the path does too, but for the curvature of turns.  x = 0, s = 0 is always
// feasible, however tight it is, and where there is room places get it; all is
// linear or a square that is positive semidefinite.  The origin stays in
// `bounds`.  Variables: x, then s.
class LinearStep : public NonlinearProgram {
 public:
  // Of a length that the clearance of a place lacks, in lengths of the path.
  static constexpr double kPenalty = 10.0;

  LinearStep(const PoseChart& chart, const std::vector<PathContacts>& places,
             const Eigen::AlignedBox3d& bounds, double margin, double trust);

  int variables() const override {
    return chart_.variables() + static_cast<int>(lacks_.size());
  }
  int rows() const override { return static_cast<int>(rows_.size()); }
  int jacobian_nonzeros() const override { return nonzeros_; }
  int hessian_nonzeros() const override {
    return chart_.variables() + 6 * (chart_.knots() - 1);
  }
  void Bounds(double* x_low, double* x_high, double* g_low,
              double* g_high) const override;
  void JacobianPattern(int* row, int* col) const override;
  void HessianPattern(int* row, int* col) const override;
  double Objective(const double* x) const override;
  void ObjectiveGradient(const double* x, double* gradient) const override;
  bool Constraints(const double* x, double* values, double* jacobian) override;
  void Hessian(const double* x, double objective_factor,
               const double* multipliers, double* values) const override;

 private:
  // Σ of slope · x over two knots, ≥ low.
  struct Row {
    int link = 0;
    Vector6 by_start = Vector6::Zero(), by_end = Vector6::Zero();
    double low = 0.0;
    int share = -1;  // variable; −1: none
    double lack = 0.0;
  };

  bool IsFree(int knot) const { return knot >= 1 && knot <= chart_.knots(); }
  void AddRows(const PathContacts& place, double margin);
  // D_i + x_i+1 − x_i
  Vector6 Link(int i, const double* x) const;

  const PoseChart& chart_;
  const Eigen::AlignedBox3d bounds_;
  const double trust_;  // over U
  std::vector<Vector6> links_;
  std::vector<double> weights_;  // 1/w
  std::vector<double> lacks_;    // c
  std::vector<Row> rows_;
  int nonzeros_ = 0;
};

}  // namespace phongpd::internal
