// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/linear_step.h"

#include <algorithm>
#include <cmath>

#include "planners/rigid/optimizer/turn_jacobian.h"

namespace phongpd::internal {
namespace {

// Of the mean length of a link: what a shorter one weighs as.
constexpr double kLeastWeight = 0.05;

}  // namespace

LinearStep::LinearStep(const PoseChart& chart,
                       const std::vector<PathContacts>& places,
                       const Eigen::AlignedBox3d& bounds, double margin,
                       double trust)
    : chart_(chart), bounds_(bounds), trust_(trust / chart.unit()) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < chart.around().size(); ++i) {
    links_.push_back(
        Difference(chart.around()[i], chart.around()[i + 1], chart.gyration()) /
        chart.unit());
    sum += links_.back().norm();
  }
  const double least = kLeastWeight * sum / static_cast<double>(links_.size());
  for (const Vector6& link : links_) {
    weights_.push_back(1.0 / std::max(link.norm(), least));
  }
  for (const PathContacts& place : places) AddRows(place, margin);
}

void LinearStep::AddRows(const PathContacts& place, double margin) {
  const auto i = static_cast<std::size_t>(place.link);
  const PoseBetween between(chart_.around()[i], chart_.around()[i + 1],
                            place.t);
  const double per_turn = 1.0 / chart_.gyration();
  const int share = chart_.variables() + static_cast<int>(lacks_.size());
  double most_lack = 0.0;
  for (const PoseContact& contact : place.contacts) {
    const Eigen::Vector3d by_turn =
        per_turn * contact.arm.cross(contact.normal);
    Row row;
    row.link = place.link;
    row.low = std::min(0.0, margin - contact.gap) / chart_.unit();
    row.lack = std::max(0.0, margin - contact.gap) / chart_.unit();
    double most = 0.0;  // that a step within the trust closes
    if (IsFree(place.link)) {
      row.by_start << (1.0 - place.t) * contact.normal,
          between.by_start.transpose() * by_turn;
      most += trust_ * row.by_start.lpNorm<1>();
    }
    if (IsFree(place.link + 1)) {
      row.by_end << place.t * contact.normal,
          between.by_end.transpose() * by_turn;
      most += trust_ * row.by_end.lpNorm<1>();
    }
    if (most <= -row.low) continue;
    nonzeros_ += 6 * (IsFree(place.link) + IsFree(place.link + 1));
    if (row.lack > 0.0) {
      row.share = share;
      most_lack = std::max(most_lack, row.lack);
      ++nonzeros_;
    }
    rows_.push_back(row);
  }
  if (most_lack > 0.0) lacks_.push_back(most_lack);
}

void LinearStep::Bounds(double* x_low, double* x_high, double* g_low,
                        double* g_high) const {
  for (int i = 1; i <= chart_.knots(); ++i) {
    const auto& middle = chart_.around()[static_cast<std::size_t>(i)].position;
    for (int k = 0; k < 6; ++k) {
      double& low = x_low[6 * (i - 1) + k];
      double& high = x_high[6 * (i - 1) + k];
      low = -trust_;
      high = trust_;
      if (k >= 3) continue;
      low = std::max(low, (bounds_.min()[k] - middle[k]) / chart_.unit());
      high = std::min(high, (bounds_.max()[k] - middle[k]) / chart_.unit());
    }
  }
  for (int i = chart_.variables(); i < variables(); ++i) {
    x_low[i] = 0.0;
    x_high[i] = 1.0;
  }
  for (const Row& row : rows_) {
    *g_low++ = row.low;
    *g_high++ = kNoBound;
  }
}

void LinearStep::JacobianPattern(int* row, int* col) const {
  for (std::size_t at = 0; at < rows_.size(); ++at) {
    for (const int knot : {rows_[at].link, rows_[at].link + 1}) {
      if (!IsFree(knot)) continue;
      for (int c = 0; c < 6; ++c) {
        *row++ = static_cast<int>(at);
        *col++ = 6 * (knot - 1) + c;
      }
    }
    if (rows_[at].share < 0) continue;
    *row++ = static_cast<int>(at);
    *col++ = rows_[at].share;
  }
}

void LinearStep::HessianPattern(int* row, int* col) const {
  for (int i = 0; i < chart_.variables(); ++i) {
    *row++ = i;
    *col++ = i;
    if (i < 6) continue;
    *row++ = i;
    *col++ = i - 6;
  }
}

Vector6 LinearStep::Link(int i, const double* x) const {
  Vector6 link = links_[static_cast<std::size_t>(i)];
  if (IsFree(i + 1)) link += Eigen::Map<const Vector6>(x + 6 * i);
  if (IsFree(i)) link -= Eigen::Map<const Vector6>(x + 6 * (i - 1));
  return link;
}

double LinearStep::Objective(const double* x) const {
  double sum = 0.0;
  for (int i = 0; i < chart_.links(); ++i) {
    sum +=
        0.5 * weights_[static_cast<std::size_t>(i)] * Link(i, x).squaredNorm();
  }
  for (std::size_t k = 0; k < lacks_.size(); ++k) {
    const auto at = static_cast<std::size_t>(chart_.variables()) + k;
    sum += kPenalty * lacks_[k] * (1.0 - x[at]);
  }
  return sum;
}

void LinearStep::ObjectiveGradient(const double* x, double* gradient) const {
  std::fill(gradient, gradient + variables(), 0.0);
  for (int i = 0; i < chart_.links(); ++i) {
    const Vector6 slope = weights_[static_cast<std::size_t>(i)] * Link(i, x);
    if (IsFree(i + 1)) Eigen::Map<Vector6>(gradient + 6 * i) += slope;
    if (IsFree(i)) Eigen::Map<Vector6>(gradient + 6 * (i - 1)) -= slope;
  }
  for (std::size_t k = 0; k < lacks_.size(); ++k) {
    gradient[static_cast<std::size_t>(chart_.variables()) + k] =
        -kPenalty * lacks_[k];
  }
}

bool LinearStep::Constraints(const double* x, double* values,
                             double* jacobian) {
  for (const Row& row : rows_) {
    double sum = 0.0;
    for (const int knot : {row.link, row.link + 1}) {
      if (!IsFree(knot)) continue;
      const Vector6& slope = knot == row.link ? row.by_start : row.by_end;
      sum += slope.dot(Eigen::Map<const Vector6>(x + 6 * (knot - 1)));
      if (jacobian != nullptr) {
        jacobian = std::copy(slope.begin(), slope.end(), jacobian);
      }
    }
    if (row.share >= 0) {
      sum -= row.lack * x[row.share];
      if (jacobian != nullptr) *jacobian++ = -row.lack;
    }
    if (values != nullptr) *values++ = sum;
  }
  return true;
}

void LinearStep::Hessian(const double* /*x*/, double objective_factor,
                         const double* /*multipliers*/, double* values) const {
  for (int i = 0; i < chart_.variables(); ++i) {
    const auto knot = static_cast<std::size_t>(i / 6);  // from 0
    *values++ = objective_factor * (weights_[knot] + weights_[knot + 1]);
    if (i >= 6) *values++ = -objective_factor * weights_[knot];
  }
}

}  // namespace phongpd::internal
