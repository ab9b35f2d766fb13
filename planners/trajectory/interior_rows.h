// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace phongpd::internal {

// How far steps lead until a slack or a dual is 0, as shares of them: 1 or
// less.  Both go as far as they can, as what is in the way of the one is seldom
// in the other's.
struct InteriorReach {
  double slack = 1.0, dual = 1.0;

  double Least() const { return slack < dual ? slack : dual; }
  InteriorReach Times(double share) const {
    return {share * slack, share * dual};
  }
};

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
  // by what they bend, towards products of `centre`: how far they lead.
  InteriorReach FollowPart(int first, int count, const double* slopes,
                           double centre);
  // Of all rows.
  InteriorReach Follow(const Eigen::ArrayXd& slopes, double centre);

  // The centre that the corrector aims at: the mean product, times the cube of
  // the share of the gap that the predictor, `reach` of it, leaves.  The steps
  // that follow know the products of its steps, but only the root of `reach` of
  // them: where it led a little way they say little (after Colombo and Gondzio,
  // 2008).
  double Predict(const InteriorReach& reach);

  // What rows change by beside the slopes of the corrector's step, as the
  // predictor's tells it.  Forgotten by Move.
  void Bend(const Eigen::ArrayXd& bends) { bends_ = bends; }

  // `reach` of the steps; the slacks may be known better.
  void Move(const InteriorReach& reach);
  void Move(const InteriorReach& reach, const Eigen::ArrayXd& slacks);

  // Of `count` rows from `first` on: μ_i for the gradient of row i in the
  // corrector's right-hand side.
  void WriteMultipliers(double centre, int first, int count, double* to) const;

  // y/s, of each: what the square of a row's gradient weighs.
  void WriteSquares(int first, int count, double* to) const;

  Eigen::ArrayXd slack, dual;

 private:
  Eigen::ArrayXd slack_step_, dual_step_;
  // Of the products of steps, which are, or were, the predictor's; 0: there are
  // none.
  double share_of_products_ = 0.0;
  Eigen::ArrayXd bends_;  // empty: none
};

}  // namespace phongpd::internal
