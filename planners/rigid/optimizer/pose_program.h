// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planners/rigid/optimizer/pose_chart.h"
#include "planners/rigid/optimizer/pose_rows.h"
#include "planners/rigid/optimizer/turn_jacobian.h"
#include "planners/trajectory/nonlinear_program.h"

namespace phongpd::internal {

// Where rows are taken: at t ∈ [0, 1] of the motion of a link, ≥ margin, user's
// unit.
struct PoseSample {
  int link = 0;
  double t = 0.0;
  double margin = 0.0;
};

// A path of poses as a program in the numbers of a PoseChart:
//
//   min Σ d²/U²   subject to   g(pose of sample)/U ≥ margin/U
//
// over the links and, for each sample, the K rows of PoseRows; the robot's
// origin within `bounds`, and no knot turned from the chart's middle by more
// than kMostTurn about an axis of the frame.  The Hessian is that of the
// energy in the chart, its curvature left out, and nothing of the rows: it is
// positive definite, and so is what steps are made of.
class PoseProgram : public NonlinearProgram {
 public:
  static constexpr double kMostTurn = 0.8;  // radians

  // `rows` must outlive this; samples of links of the chart.
  PoseProgram(PoseChart chart, std::vector<PoseSample> samples,
              const Eigen::AlignedBox3d& bounds, PoseRows* rows);

  const PoseChart& chart() const { return chart_; }

  int variables() const override { return chart_.variables(); }
  int rows() const override {
    return static_cast<int>(samples_.size()) * rows_.rows();
  }
  int jacobian_nonzeros() const override { return nonzeros_; }
  int hessian_nonzeros() const override {
    return chart_.variables() + 6 * (chart_.knots() - 1);
  }
  void Bounds(double* x_low, double* x_high, double* g_low,
              double* g_high) const override;
  void JacobianPattern(int* row, int* col) const override;
  void HessianPattern(int* row, int* col) const override;
  double Objective(const double* x) const override { return chart_.Energy(x); }
  void ObjectiveGradient(const double* x, double* gradient) const override {
    chart_.EnergyGradient(x, gradient);
  }
  bool Constraints(const double* x, double* values, double* jacobian) override;
  void Hessian(const double* x, double objective_factor,
               const double* multipliers, double* values) const override;
  // The tracks go on to those of x.
  int Accept(const double* x) override;

 private:
  bool IsFree(int knot) const { return knot >= 1 && knot <= chart_.knots(); }

  PoseChart chart_;
  std::vector<PoseSample> samples_;
  Eigen::AlignedBox3d bounds_;
  PoseRows& rows_;
  int nonzeros_ = 0;
  std::vector<PoseTracks> tracks_;  // of the samples
  // What they become if the last point evaluated is accepted.
  std::vector<PoseTracks> next_;
  Eigen::VectorXd next_at_;
};

}  // namespace phongpd::internal
