// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/interior_rows.h"

#include <algorithm>

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
  is_predicted_ = false;
  bends_.resize(0);
}

double InteriorRows::FollowPart(int first, int count, const double* slopes,
                                double centre) {
  const Eigen::Map<const ArrayXd> all(slopes, count);
  double most = 0.0;
  ForParts(first, count, [&](Index at, Index n) {
    auto slack_step = slack_step_.segment(at, n);
    auto dual_step = dual_step_.segment(at, n);
    const auto y = dual.segment(at, n);
    const Part inverse = slack.segment(at, n).inverse();
    Part aim = Part::Constant(n, centre);
    if (is_predicted_) aim -= slack_step * dual_step;
    slack_step = -all.segment(at - first, n);
    if (bends_.size() > 0) slack_step -= bends_.segment(at, n);
    dual_step = (aim - y * slack_step) * inverse - y;
    most = std::max({most, (-slack_step * inverse).maxCoeff(),
                     (-dual_step * y.inverse()).maxCoeff()});
  });
  return most;
}

double InteriorRows::Follow(const ArrayXd& slopes, double centre) {
  return 1.0 / std::max(1.0, FollowPart(0, size(), slopes.data(), centre));
}

double InteriorRows::Predict(double reach) {
  double gap = 0.0, after = 0.0;
  ForParts(0, size(), [&](Index at, Index n) {
    const auto s = slack.segment(at, n), y = dual.segment(at, n);
    gap += (s * y).sum();
    after += ((s + reach * slack_step_.segment(at, n)) *
              (y + reach * dual_step_.segment(at, n)))
                 .sum();
  });
  is_predicted_ = true;
  const double ratio = after / gap;
  return ratio * ratio * ratio * gap / size();
}

void InteriorRows::WriteMultipliers(double centre, int first, int count,
                                    double* to) const {
  Eigen::Map<ArrayXd> all(to, count);
  if (is_predicted_) {
    all = slack_step_.segment(first, count) * dual_step_.segment(first, count) -
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

void InteriorRows::Move(double reach) {
  ForParts(0, size(), [&](Index at, Index n) {
    slack.segment(at, n) += reach * slack_step_.segment(at, n);
    dual.segment(at, n) += reach * dual_step_.segment(at, n);
  });
  is_predicted_ = false;
  bends_.resize(0);
}

void InteriorRows::Move(double reach, const ArrayXd& slacks) {
  slack = slacks;
  dual += reach * dual_step_;
  is_predicted_ = false;
  bends_.resize(0);
}

}  // namespace phongpd::internal
