// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/trajectory_nlp.h"

#include <algorithm>
#include <utility>

namespace phongpd {

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// Free means strictly inside the bounds, so waypoints keep this far away from
// them, in units of D; more than Ipopt's relaxation of 1e-8.
constexpr double kBoundInset = 1e-6;

}  // namespace

TrajectoryNlp::TrajectoryNlp(const TrajectoryProblem& problem,
                             const std::vector<int>& samples,
                             double start_length, int rows)
    : start_(problem.start),
      goal_(problem.goal),
      margin_(problem.margin),
      springs_(problem, start_length),
      bounds_(problem.free_space->bounds()),
      contact_(problem.metrics, problem.start, problem.goal, problem.waypoints,
               samples, rows, {springs_.center, springs_.unit}) {}

VectorXd TrajectoryNlp::ToVariables(const Path& path) const {
  return springs_.ToVariables(path);
}

Path TrajectoryNlp::ToPath(const VectorXd& u) const {
  return springs_.ToPath(start_, u.data(), goal_);
}

void TrajectoryNlp::Start(const VectorXd& u) {
  branches_ = contact_.Start(u.data(), &counts_);
  next_ = branches_;
  next_at_.resize(0);
}

void TrajectoryNlp::Bounds(double* x_low, double* x_high, double* g_low,
                           double* g_high) const {
  std::fill(x_low, x_low + variables(), -kNoBound);
  std::fill(x_high, x_high + variables(), kNoBound);
  if (!bounds_.IsEmpty()) {
    for (int i = 0; i < variables(); ++i) {
      const int axis = i % 3;
      const double c = springs_.center[axis];
      // In a box thinner than two insets the middle is what is left.
      const double low = (bounds_.min[axis] - c) / springs_.unit;
      const double high = (bounds_.max[axis] - c) / springs_.unit;
      const double inset = std::min(kBoundInset, 0.49 * (high - low));
      x_low[i] = low + inset;
      x_high[i] = high - inset;
    }
  }
  std::fill(g_low, g_low + contact_.rows(), margin_);
  std::fill(g_high, g_high + contact_.rows(), kNoBound);
  std::fill(g_low + contact_.rows(), g_low + rows(), -kNoBound);
  std::fill(g_high + contact_.rows(), g_high + rows(), springs_.eta);
}

void TrajectoryNlp::JacobianPattern(int* row, int* col) const {
  contact_.Sparsity(row, col);
  springs_.JacobianPattern(contact_.rows(), row + contact_.nonzeros(),
                           col + contact_.nonzeros());
}

void TrajectoryNlp::HessianPattern(int* row, int* col) const {
  springs_.HessianPattern(row, col);
}

double TrajectoryNlp::Objective(const double* x) const {
  return springs_.Energy(x);
}

void TrajectoryNlp::ObjectiveGradient(const double* x, double* gradient) const {
  springs_.Gradient(x, gradient);
}

bool TrajectoryNlp::Constraints(const double* x, double* values,
                                double* jacobian) {
  next_at_.resize(0);
  if (!contact_.Evaluate(x, branches_, values, jacobian, &counts_, &next_)) {
    return false;
  }
  next_at_ = Eigen::Map<const VectorXd>(x, variables());
  values += contact_.rows();
  return springs_.Lengths(x, values, jacobian + contact_.nonzeros());
}

void TrajectoryNlp::Hessian(const double* /*x*/, double objective_factor,
                            const double* multipliers, double* values) const {
  springs_.Hessian(objective_factor, multipliers + contact_.rows(), values);
}

int TrajectoryNlp::Accept(const double* x) {
  if (next_at_.size() > 0 &&
      next_at_ == Eigen::Map<const VectorXd>(x, variables())) {
    std::swap(branches_, next_);
    next_at_.resize(0);
    counts_.branch_changes += branches_.changes;
  } else {
    contact_.Commit(x, &branches_, &counts_);
  }
  return static_cast<int>(branches_.changes);
}

}  // namespace phongpd
