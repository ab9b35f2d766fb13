// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace phongpd::internal {

// Slacks s > 0 and duals y > 0 of the rows of a convex program, and a step of
// both, as an interior point method with Mehrotra's predictor and corrector
// moves them.  Rows lie one after another, so that what is done to each is done
// to several at once.
class InteriorRows {
 public:
  int size() const { return static_cast<int>(slack.size()); }

  // At those slacks, with those products s·y > 0.
  void Begin(const Eigen::ArrayXd& slacks, const Eigen::ArrayXd& products);

  double Gap() const { return (slack * dual).sum(); }  // Σ s·y

  // The steps of `count` rows from `first` on that change by those slopes, and
  // by what they bend, towards products of `centre`: by how much too long they
  // are, 0 or less where nothing ends them.
  double FollowPart(int first, int count, const double* slopes, double centre);
  // Of all rows; how far the steps lead at most, 1 or less.
  double Follow(const Eigen::ArrayXd& slopes, double centre);

  // The centre that the corrector aims at: the mean product, times the cube of
  // the share of the gap that the predictor, `reach` of it, leaves.  The steps
  // that follow know the products of its steps.
  double Predict(double reach);

  // What rows change by beside the slopes of the corrector's step, as the
  // predictor's tells it.  Forgotten by Move.
  void Bend(const Eigen::ArrayXd& bends) { bends_ = bends; }

  // `reach` of the steps; the slacks may be known better.
  void Move(double reach);
  void Move(double reach, const Eigen::ArrayXd& slacks);

  // Of `count` rows from `first` on: μ_i for the gradient of row i in the
  // corrector's right-hand side.
  void WriteMultipliers(double centre, int first, int count, double* to) const;

  // y/s, of each: what the square of a row's gradient weighs.
  void WriteSquares(int first, int count, double* to) const;

  Eigen::ArrayXd slack, dual;

 private:
  Eigen::ArrayXd slack_step_, dual_step_;
  bool is_predicted_ = false;  // they are, or were, the predictor's
  Eigen::ArrayXd bends_;       // empty: none
};

}  // namespace phongpd::internal
