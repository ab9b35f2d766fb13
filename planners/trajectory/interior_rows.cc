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
  product_ = slack_step_ = dual_step_ = ArrayXd::Zero(size());
  bends_.resize(0);
}

double InteriorRows::Follow(const ArrayXd& slopes, double centre) {
  double shrinks = 1.0;
  ForParts(size(), [&](Index at, Index n) {
    auto slack_step = slack_step_.segment(at, n);
    auto dual_step = dual_step_.segment(at, n);
    const auto inverse_slack = inverse_slack_.segment(at, n);
    const auto y = dual.segment(at, n);
    slack_step = -slopes.segment(at, n);
    if (bends_.size() > 0) slack_step -= bends_.segment(at, n);
    dual_step =
        (centre - product_.segment(at, n) - y * slack_step) * inverse_slack - y;
    shrinks =
        std::max({shrinks, (-slack_step * inverse_slack).maxCoeff(),
                  (-dual_step * inverse_dual_.segment(at, n)).maxCoeff()});
  });
  return 1.0 / shrinks;
}

double InteriorRows::Predict(double reach) {
  double gap = 0.0, after = 0.0;
  ForParts(size(), [&](Index at, Index n) {
    const auto s = slack.segment(at, n), y = dual.segment(at, n);
    const auto slack_step = slack_step_.segment(at, n);
    const auto dual_step = dual_step_.segment(at, n);
    gap += (s * y).sum();
    after += ((s + reach * slack_step) * (y + reach * dual_step)).sum();
    product_.segment(at, n) = slack_step * dual_step;
  });
  const double ratio = after / gap;
  return ratio * ratio * ratio * gap / size();
}

void InteriorRows::WriteMultipliers(double centre, int first, int count,
                                    double* to) const {
  Eigen::Map<ArrayXd> all(to, count);
  all = product_.segment(first, count) - centre;
  if (bends_.size() > 0) {
    all -= dual.segment(first, count) * bends_.segment(first, count);
  }
  all *= inverse_slack_.segment(first, count);
}

void InteriorRows::WriteSquares(int first, int count, double* to) const {
  Eigen::Map<ArrayXd>(to, count) =
      dual.segment(first, count) * inverse_slack_.segment(first, count);
}

void InteriorRows::Move(double reach) {
  ForParts(size(), [&](Index at, Index n) {
    MovePart(at, n, reach,
             slack.segment(at, n) + reach * slack_step_.segment(at, n));
  });
  bends_.resize(0);
}

void InteriorRows::Move(double reach, const ArrayXd& slacks) {
  ForParts(size(), [&](Index at, Index n) {
    MovePart(at, n, reach, slacks.segment(at, n));
  });
  bends_.resize(0);
}

template <typename Slacks>
void InteriorRows::MovePart(Index at, Index n, double reach,
                            const Slacks& slacks) {
  slack.segment(at, n) = slacks;
  inverse_slack_.segment(at, n) = slack.segment(at, n).inverse();
  dual.segment(at, n) += reach * dual_step_.segment(at, n);
  inverse_dual_.segment(at, n) = dual.segment(at, n).inverse();
  product_.segment(at, n).setZero();
}

}  // namespace phongpd::internal
