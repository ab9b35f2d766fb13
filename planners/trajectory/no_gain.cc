// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/no_gain.h"

#include <algorithm>

namespace phongpd {
namespace {

constexpr double kNearlyFeasible = 1e-3;
constexpr double kStepsLeft = 10.0;

}  // namespace

void NoGain::Stop(IpoptSettings* settings) {
  settings->on_iteration = [this, next = settings->on_iteration](
                               const IterationRecord& record,
                               const Eigen::VectorXd& x) {
    See(record);
    const bool goes_on = !next || next(record, x);
    return goes_on && !has_ended_;
  };
}

void NoGain::See(const IterationRecord& record) {
  if (record.is_restoration || record.violation > kNearlyFeasible) {
    feasible_ = 0;
    return;
  }
  const std::size_t count = losses_.size();
  if (feasible_ > 0) {
    losses_[static_cast<std::size_t>(feasible_ - 1) % count] =
        last_ - record.objective;
  }
  last_ = record.objective;
  ++feasible_;
  const double most =
      std::max(0.0, *std::max_element(losses_.begin(), losses_.end()));
  has_ended_ = feasible_ > static_cast<int>(count) &&
               record.objective - kStepsLeft * most > limit_;
}

}  // namespace phongpd
