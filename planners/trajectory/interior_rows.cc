// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/interior_rows.h"

#include <algorithm>

namespace phongpd::internal {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

// act(first row, how many) for parts that stay in the first cache while all
// that is done to them is done.
template <typename Act>
void ForParts(Index rows, const Act& act) {
  constexpr Index kRows = 256;
  for (Index at = 0; at < rows; at += kRows) {
    act(at, std::min(kRows, rows - at));
  }
}

}  // namespace

void InteriorRows::Begin(const ArrayXd& slacks, const ArrayXd& products) {
  slack = slacks;
  inverse_slack_ = slack.inverse();
  dual = products * inverse_slack_;
  inverse_dual_ = dual.inverse();
  product_ = bends_ = ArrayXd::Zero(size());
  slack_step_ = dual_step_ = ArrayXd::Zero(size());
}

double InteriorRows::Follow(const ArrayXd& slopes, double centre) {
  double shrinks = 1.0;
  ForParts(size(), [&](Index at, Index n) {
    auto slack_step = slack_step_.segment(at, n);
    auto dual_step = dual_step_.segment(at, n);
    const auto inverse_slack = inverse_slack_.segment(at, n);
    const auto y = dual.segment(at, n);
    slack_step = -slopes.segment(at, n) - bends_.segment(at, n);
    dual_step =
        (centre - product_.segment(at, n) - y * slack_step) * inverse_slack - y;
    shrinks =
        std::max({shrinks, (-slack_step * inverse_slack).maxCoeff(),
                  (-dual_step * inverse_dual_.segment(at, n)).maxCoeff()});
  });
  return 1.0 / shrinks;
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
  ForParts(size(), [&](Index at, Index n) {
    slack.segment(at, n) = slacks.segment(at, n);
    inverse_slack_.segment(at, n) = slack.segment(at, n).inverse();
    dual.segment(at, n) += reach * dual_step_.segment(at, n);
    inverse_dual_.segment(at, n) = dual.segment(at, n).inverse();
    product_.segment(at, n).setZero();
    bends_.segment(at, n).setZero();
  });
}

}  // namespace phongpd::internal
