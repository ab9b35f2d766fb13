// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/interior_rows.h"

#include <algorithm>
#include <cmath>

namespace phongpd::internal {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr int kRowsOfPart = 256;
using Part = Eigen::Array<double, Eigen::Dynamic, 1, 0, kRowsOfPart, 1>;

// act(first row, how many) for parts that stay in the first cache while all
// that is done to them is done.  What follows from others is computed again:
// it takes less time than to fetch it.
template <typename Act>
void ForParts(int first, int rows, const Act& act) {
  for (int at = 0; at < rows; at += kRowsOfPart) {
    act(first + at, std::min(kRowsOfPart, rows - at));
  }
}

}  // namespace

void InteriorRows::Begin(const ArrayXd& slacks, const ArrayXd& products) {
  slack = slacks;
  dual = products * slack.inverse();
  slack_step_ = dual_step_ = ArrayXd::Zero(size());
  share_of_products_ = 0.0;
  bends_.resize(0);
}

InteriorReach InteriorRows::FollowPart(int first, int count,
                                       const double* slopes, double centre) {
  const Eigen::Map<const ArrayXd> all(slopes, count);
  // By how much steps are too long.
  double of_slacks = 1.0, of_duals = 1.0;
  ForParts(first, count, [&](Index at, Index n) {
    auto slack_step = slack_step_.segment(at, n);
    auto dual_step = dual_step_.segment(at, n);
    const auto y = dual.segment(at, n);
    const Part inverse = slack.segment(at, n).inverse();
    Part aim = Part::Constant(n, centre);
    if (share_of_products_ > 0.0) {
      aim -= share_of_products_ * slack_step * dual_step;
    }
    slack_step = -all.segment(at - first, n);
    if (bends_.size() > 0) slack_step -= bends_.segment(at, n);
    dual_step = (aim - y * slack_step) * inverse - y;
    of_slacks = std::max(of_slacks, (-slack_step * inverse).maxCoeff());
    of_duals = std::max(of_duals, (-dual_step * y.inverse()).maxCoeff());
  });
  return {1.0 / of_slacks, 1.0 / of_duals};
}

InteriorReach InteriorRows::Follow(const ArrayXd& slopes, double centre) {
  return FollowPart(0, size(), slopes.data(), centre);
}

double InteriorRows::Predict(const InteriorReach& reach) {
  double gap = 0.0, after = 0.0;
  ForParts(0, size(), [&](Index at, Index n) {
    const auto s = slack.segment(at, n), y = dual.segment(at, n);
    gap += (s * y).sum();
    after += ((s + reach.slack * slack_step_.segment(at, n)) *
              (y + reach.dual * dual_step_.segment(at, n)))
                 .sum();
  });
  share_of_products_ = std::sqrt(reach.Least());
  const double ratio = after / gap;
  return ratio * ratio * ratio * gap / size();
}

void InteriorRows::WriteMultipliers(double centre, int first, int count,
                                    double* to) const {
  Eigen::Map<ArrayXd> all(to, count);
  if (share_of_products_ > 0.0) {
    all = share_of_products_ * slack_step_.segment(first, count) *
              dual_step_.segment(first, count) -
          centre;
  } else {
    all.setConstant(-centre);
  }
  if (bends_.size() > 0) {
    all -= dual.segment(first, count) * bends_.segment(first, count);
  }
  all *= slack.segment(first, count).inverse();
}

void InteriorRows::WriteSquares(int first, int count, double* to) const {
  Eigen::Map<ArrayXd>(to, count) =
      dual.segment(first, count) * slack.segment(first, count).inverse();
}

void InteriorRows::Move(const InteriorReach& reach) {
  ForParts(0, size(), [&](Index at, Index n) {
    slack.segment(at, n) += reach.slack * slack_step_.segment(at, n);
    dual.segment(at, n) += reach.dual * dual_step_.segment(at, n);
  });
  share_of_products_ = 0.0;
  bends_.resize(0);
}

void InteriorRows::Move(const InteriorReach& reach, const ArrayXd& slacks) {
  slack = slacks;
  dual += reach.dual * dual_step_;
  share_of_products_ = 0.0;
  bends_.resize(0);
}

}  // namespace phongpd::internal
