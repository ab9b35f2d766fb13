// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planners/trajectory/interior_rows.h"
#include "planners/trajectory/joint_program.h"

namespace phongpd::internal {

// By Mehrotra's predictor and corrector from within, as CurveInteriorPoint; a
// knot's block has the unknowns of all curves.  Limits by norm are rows that
// touch the ball where the curve is now: what that neglects is of second order,
// as the rest.
class JointInteriorPoint {
 public:
  explicit JointInteriorPoint(const JointProgram& program);

  struct Result {
    Eigen::VectorXd x;  // as JointUnknowns has it
    int iterations = 0;
    int rows = 0;
  };
  Result Solve();

 private:
  // sign · (along) + t · (its unknown) + constant ≤ 0, of both signs where
  // there are two sides, which are rows `at` and the next.
  struct Line {
    int first = -1, second = -1;  // curves; −1: none
    int from = 0, to = -1;
    int axis = -1;  // of the direction, or −1
    Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    double eta = 0.0, theta = 0.0, t = 0.0;
    int sides = 1, at = 0;
    std::array<double, 2> constant = {0.0, 0.0};
  };

  void AddLines(int curve, int piece);
  void AddBoundLines(int curve, const CurveProgram::Bounds& bounds,
                     std::vector<Line>* lines) const;
  void AddNormLines(int curve, const CurveProgram::Row& row,
                    std::vector<Line>* lines) const;
  void AddJointRows();

  double Along(const Line& line, const Eigen::VectorXd& local) const;
  void AddSquare(const Line& line, double by, Eigen::MatrixXd* m) const;
  void AddLine(const Line& line, double by, Eigen::VectorXd* local) const;
  // ± along + t · (its unknown), of both sides: what a step changes them by.
  void FindSlopes(const Eigen::VectorXd& x);
  double FirstT() const;
  bool Begin(Eigen::VectorXd* x);
  void AddRows(WideTridiagonal* matrix, Eigen::VectorXd* residual) const;
  void AddCentres(double centre, Eigen::VectorXd* to) const;

  const JointProgram& program_;
  const JointUnknowns unknowns_;
  WideTridiagonal hessian_;
  Eigen::VectorXd linear_;
  std::vector<std::vector<Line>> lines_;  // by piece
  InteriorRows state_;
  Eigen::ArrayXd slopes_;  // of each row
};

}  // namespace phongpd::internal
