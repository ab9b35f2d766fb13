// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/trajectory_nlp.h"

#include <algorithm>
#include <cmath>

namespace phongpd {

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kNoBound = 2e19;  // Ipopt's infinity is 1e19
// Free means strictly inside the bounds, so waypoints keep this far away from
// them, in units of D; more than Ipopt's relaxation of 1e-8.
constexpr double kBoundInset = 1e-6;

PathFrame Frame(const TrajectoryProblem& problem) {
  return {0.5 * problem.start + 0.5 * problem.goal, Diagonal(problem)};
}

NonPenetrationOptions ContactOptions(const TrajectoryProblem& problem,
                                     const TrajectoryNlpOptions& options) {
  NonPenetrationOptions contact;
  contact.frame = Frame(problem);
  contact.rows = options.rows;
  contact.policy = options.policy;
  contact.merge_spaces = options.merge_spaces;
  return contact;
}

}  // namespace

TrajectoryNlp::TrajectoryNlp(const TrajectoryProblem& problem,
                             const std::vector<int>& samples,
                             double start_length,
                             const TrajectoryNlpOptions& options)
    : frame_(Frame(problem)),
      waypoints_(problem.waypoints),
      start_(problem.start),
      goal_(problem.goal),
      u_start_((problem.start - frame_.center) / frame_.unit),
      u_goal_((problem.goal - frame_.center) / frame_.unit),
      margin_(problem.margin),
      eta_(MaxSegment(problem, start_length) / frame_.unit),
      bounds_(problem.free_space->bounds()),
      contact_(problem.metrics, problem.start, problem.goal, problem.waypoints,
               samples, ContactOptions(problem, options)) {
  const double reference = std::max((u_goal_ - u_start_).norm(), 1e-3);
  weight_ = (waypoints_ + 1) / (reference * reference);
}

VectorXd TrajectoryNlp::ToVariables(const Path& path) const {
  VectorXd u(variables());
  for (int i = 0; i < waypoints_; ++i) {
    u.segment<3>(3 * i) =
        (path[static_cast<std::size_t>(i + 1)] - frame_.center) / frame_.unit;
  }
  return u;
}

Path TrajectoryNlp::ToPath(const VectorXd& u) const {
  Path path{start_};
  for (int i = 0; i < waypoints_; ++i) {
    path.push_back(frame_.center + frame_.unit * u.segment<3>(3 * i));
  }
  path.push_back(goal_);
  return path;
}

void TrajectoryNlp::Start(const VectorXd& u) {
  branches_ = contact_.Start(u.data(), &counts_);
}

Vector3d TrajectoryNlp::Step(int segment, const double* x) const {
  using Map = Eigen::Map<const Vector3d>;
  const Vector3d from =
      segment == 0 ? u_start_ : Vector3d(Map(x + 3 * (segment - 1)));
  const Vector3d to =
      segment == waypoints_ ? u_goal_ : Vector3d(Map(x + 3 * segment));
  return to - from;
}

void TrajectoryNlp::Bounds(double* x_low, double* x_high, double* g_low,
                           double* g_high) const {
  std::fill(x_low, x_low + variables(), -kNoBound);
  std::fill(x_high, x_high + variables(), kNoBound);
  if (!bounds_.IsEmpty()) {
    for (int i = 0; i < variables(); ++i) {
      const int axis = i % 3;
      const double c = frame_.center[axis];
      // In a box thinner than two insets the middle is what is left.
      const double low = (bounds_.min[axis] - c) / frame_.unit;
      const double high = (bounds_.max[axis] - c) / frame_.unit;
      const double inset = std::min(kBoundInset, 0.49 * (high - low));
      x_low[i] = low + inset;
      x_high[i] = high - inset;
    }
  }
  std::fill(g_low, g_low + contact_.rows(), margin_);
  std::fill(g_high, g_high + contact_.rows(), kNoBound);
  std::fill(g_low + contact_.rows(), g_low + rows(), -kNoBound);
  std::fill(g_high + contact_.rows(), g_high + rows(), eta_);
}

void TrajectoryNlp::JacobianPattern(int* row, int* col) const {
  contact_.Sparsity(row, col);
  row += contact_.nonzeros();
  col += contact_.nonzeros();
  for (int segment = 0; segment <= waypoints_; ++segment) {
    for (int end = 0; end < 2; ++end) {
      const int waypoint = segment - 1 + end;  // 0 … N−1 are free
      if (waypoint < 0 || waypoint >= waypoints_) continue;
      for (int axis = 0; axis < 3; ++axis) {
        *row++ = contact_.rows() + segment;
        *col++ = 3 * waypoint + axis;
      }
    }
  }
}

// The diagonal, then the entries three below it.
void TrajectoryNlp::HessianPattern(int* row, int* col) const {
  for (int i = 0; i < variables(); ++i) {
    *row++ = i;
    *col++ = i;
  }
  for (int i = 3; i < variables(); ++i) {
    *row++ = i;
    *col++ = i - 3;
  }
}

double TrajectoryNlp::Objective(const double* x) const {
  double sum = 0.0;
  for (int i = 0; i <= waypoints_; ++i) sum += Step(i, x).squaredNorm();
  return weight_ * sum;
}

void TrajectoryNlp::ObjectiveGradient(const double* x, double* gradient) const {
  for (int i = 0; i < waypoints_; ++i) {
    Eigen::Map<Vector3d>(gradient + 3 * i) =
        2.0 * weight_ * (Step(i, x) - Step(i + 1, x));
  }
}

bool TrajectoryNlp::Constraints(const double* x, double* values,
                                double* jacobian) {
  if (!contact_.Evaluate(x, branches_, values, jacobian, &counts_)) {
    return false;
  }
  values += contact_.rows();
  jacobian += contact_.nonzeros();
  for (int i = 0; i <= waypoints_; ++i) {
    const Vector3d step = Step(i, x);
    values[i] = step.squaredNorm() / eta_;
    if (!std::isfinite(values[i])) return false;
    for (int end = 0; end < 2; ++end) {
      const int waypoint = i - 1 + end;
      if (waypoint < 0 || waypoint >= waypoints_) continue;
      const double sign = end == 0 ? -2.0 : 2.0;
      for (int axis = 0; axis < 3; ++axis) {
        *jacobian++ = sign * step[axis] / eta_;
      }
    }
  }
  return true;
}

void TrajectoryNlp::Hessian(const double* /*x*/, double objective_factor,
                            const double* multipliers, double* values) const {
  // Every segment is a spring: 2k on the diagonal of both its ends, −2k
  // between them.
  const double* length_multipliers = multipliers + contact_.rows();
  const auto stiffness = [&](int segment) {
    return objective_factor * weight_ + length_multipliers[segment] / eta_;
  };
  for (int i = 0; i < waypoints_; ++i) {
    const double diagonal = 2.0 * (stiffness(i) + stiffness(i + 1));
    std::fill(values, values + 3, diagonal);
    values += 3;
  }
  for (int i = 1; i < waypoints_; ++i) {
    std::fill(values, values + 3, -2.0 * stiffness(i));
    values += 3;
  }
}

int TrajectoryNlp::Accept(const double* x) {
  const long before = counts_.branch_changes;
  contact_.Commit(x, &branches_, &counts_);
  return static_cast<int>(counts_.branch_changes - before);
}

}  // namespace phongpd
