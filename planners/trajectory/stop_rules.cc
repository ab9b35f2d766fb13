// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/stop_rules.h"

#include <cmath>

namespace phongpd {
namespace {

constexpr double kStallGain = 1e-3;

}  // namespace

bool StopRules::MustStop(const IterationRecord& record,
                         const Eigen::VectorXd& x, bool is_cancelled) {
  if (record.violation <= kFeasibility) {
    if (!has_best_ || record.objective < best_objective_) {
      best_x_ = x;
      best_objective_ = record.objective;
    }
    const double gain = kStallGain * std::abs(stall_reference_);
    if (!has_best_ || record.objective < stall_reference_ - gain) {
      stall_reference_ = record.objective;
      stalled_ = -1;
    }
    has_best_ = true;
  }
  ++stalled_;
  if (is_cancelled) {
    reason_ = SolveStatus::kCancelled;
  } else if (stopwatch_.Seconds() > settings_.time_limit) {
    reason_ = SolveStatus::kTimeLimit;
  } else if (settings_.stall_iterations > 0 && has_best_ &&
             stalled_ >= settings_.stall_iterations) {
    reason_ = SolveStatus::kStalledFeasible;
  }
  return reason_.has_value();
}

}  // namespace phongpd
