// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/stopwatch.h"
#include "planners/trajectory/ipopt_solve.h"

namespace phongpd {

// When a solve is stopped from outside (IpoptSettings: cancelled, time limit,
// stall), and the best feasible iterate until then.
class StopRules {
 public:
  // The clock starts; the settings must outlive this.
  explicit StopRules(const IpoptSettings& settings) : settings_(settings) {}

  // Notes the accepted iterate x; true if the solver must stop.
  bool MustStop(const IterationRecord& record, const Eigen::VectorXd& x,
                bool is_cancelled);

  // Why it must, once it must.
  std::optional<SolveStatus> reason() const { return reason_; }

  // The feasible iterate of the smallest objective, nullptr: none.
  const Eigen::VectorXd* best() const { return has_best_ ? &best_x_ : nullptr; }

 private:
  const IpoptSettings& settings_;
  Stopwatch stopwatch_;
  Eigen::VectorXd best_x_;
  bool has_best_ = false;
  double best_objective_ = 0.0;
  double stall_reference_ = 0.0;  // objective when it last improved enough
  int stalled_ = 0;               // iterations since then
  std::optional<SolveStatus> reason_;
};

}  // namespace phongpd
