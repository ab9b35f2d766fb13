// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/interior_rows.h"

#include <algorithm>

namespace phongpd::internal {

using Eigen::ArrayXd;

void InteriorRows::Begin(const ArrayXd& slacks, double mu) {
  slack = slacks;
  inverse_slack_ = slack.inverse();
  dual = mu * inverse_slack_;
  inverse_dual_ = dual.inverse();
  product_ = ArrayXd::Zero(size());
  bends_ = ArrayXd::Zero(size());
}

double InteriorRows::Follow(const ArrayXd& slopes, double centre) {
  slack_step_ = -slopes - bends_;
  dual_step_ = (centre - product_ - dual * slack_step_) * inverse_slack_ - dual;
  if (size() == 0) return 1.0;
  const double shrinks = std::max((-slack_step_ * inverse_slack_).maxCoeff(),
                                  (-dual_step_ * inverse_dual_).maxCoeff());
  return 1.0 / std::max(1.0, shrinks);
}

double InteriorRows::Predict(double reach) {
  const double gap = Gap();
  const double after =
      ((slack + reach * slack_step_) * (dual + reach * dual_step_)).sum();
  product_ = slack_step_ * dual_step_;
  const double ratio = after / gap;
  return ratio * ratio * ratio * gap / size();
}

void InteriorRows::Move(double reach) {
  Move(reach, slack + reach * slack_step_);
}

void InteriorRows::Move(double reach, const ArrayXd& slacks) {
  slack = slacks;
  inverse_slack_ = slack.inverse();
  dual += reach * dual_step_;
  inverse_dual_ = dual.inverse();
  product_.setZero();
  bends_.setZero();
}

}  // namespace phongpd::internal
