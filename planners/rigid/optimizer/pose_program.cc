// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/optimizer/pose_program.h"

#include <algorithm>
#include <utility>

namespace phongpd::internal {
namespace {

using Eigen::VectorXd;

// Free of the bounds by rounding, in U; more than Ipopt's relaxation of 1e-8.
constexpr double kBoundInset = 1e-6;

}  // namespace

PoseProgram::PoseProgram(PoseChart chart, std::vector<PoseSample> samples,
                         const Eigen::AlignedBox3d& bounds, PoseRows* rows)
    : chart_(std::move(chart)),
      samples_(std::move(samples)),
      bounds_(bounds),
      rows_(*rows),
      tracks_(samples_.size()),
      next_(samples_.size()) {
  for (const PoseSample& sample : samples_) {
    nonzeros_ +=
        6 * rows_.rows() * (IsFree(sample.link) + IsFree(sample.link + 1));
  }
}

void PoseProgram::Bounds(double* x_low, double* x_high, double* g_low,
                         double* g_high) const {
  const double unit = chart_.unit();
  const double turn = kMostTurn * chart_.gyration() / unit;
  for (int i = 1; i <= chart_.knots(); ++i) {
    const auto& middle = chart_.around()[static_cast<std::size_t>(i)].position;
    for (int k = 0; k < 6; ++k) {
      double& low = x_low[6 * (i - 1) + k];
      double& high = x_high[6 * (i - 1) + k];
      low = -turn;
      high = turn;
      if (k >= 3) continue;
      low = (bounds_.min()[k] - middle[k]) / unit;
      high = (bounds_.max()[k] - middle[k]) / unit;
      // In a box thinner than two insets the middle is what is left.
      const double inset = std::min(kBoundInset, 0.49 * (high - low));
      low += inset;
      high -= inset;
    }
  }
  for (const PoseSample& sample : samples_) {
    for (int k = 0; k < rows_.rows(); ++k) {
      *g_low++ = sample.margin / unit;
      *g_high++ = kNoBound;
    }
  }
}

void PoseProgram::JacobianPattern(int* row, int* col) const {
  int at = 0;
  for (const PoseSample& sample : samples_) {
    for (int k = 0; k < rows_.rows(); ++k, ++at) {
      for (const int knot : {sample.link, sample.link + 1}) {
        if (!IsFree(knot)) continue;
        for (int c = 0; c < 6; ++c) {
          *row++ = at;
          *col++ = 6 * (knot - 1) + c;
        }
      }
    }
  }
}

void PoseProgram::HessianPattern(int* row, int* col) const {
  for (int i = 0; i < variables(); ++i) {
    *row++ = i;
    *col++ = i;
    if (i < 6) continue;
    *row++ = i;
    *col++ = i - 6;
  }
}

void PoseProgram::Hessian(const double* /*x*/, double objective_factor,
                          const double* /*multipliers*/, double* values) const {
  for (int i = 0; i < variables(); ++i) {
    *values++ = 4.0 * objective_factor;
    if (i >= 6) *values++ = -2.0 * objective_factor;
  }
}

bool PoseProgram::Constraints(const double* x, double* values,
                              double* jacobian) {
  next_at_.resize(0);
  const std::vector<RobotPose> poses = chart_.Poses(x);
  const double unit = chart_.unit();
  PoseRowEntries entries;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const int link = samples_[i].link;
    const double t = samples_[i].t;
    const PoseBetween between(poses[static_cast<std::size_t>(link)],
                              poses[static_cast<std::size_t>(link) + 1], t);
    if (!rows_.At(between.pose, tracks_[i], &next_[i], &entries)) return false;
    for (int k = 0; k < rows_.rows(); ++k) {
      const PoseRowEntry& entry = entries[static_cast<std::size_t>(k)];
      if (values != nullptr) *values++ = entry.value / unit;
      if (jacobian == nullptr) continue;
      for (const int knot : {link, link + 1}) {
        if (!IsFree(knot)) continue;
        const bool is_start = knot == link;
        Vector6 slope;
        slope << (is_start ? 1.0 - t : t) * entry.by_pose.head<3>(),
            (is_start ? between.by_start : between.by_end).transpose() *
                entry.by_pose.tail<3>();
        const Vector6 numbers = chart_.ByNumbers(knot, x, slope) / unit;
        jacobian = std::copy(numbers.begin(), numbers.end(), jacobian);
      }
    }
  }
  next_at_ = Eigen::Map<const VectorXd>(x, variables());
  return true;
}

int PoseProgram::Accept(const double* x) {
  if (next_at_.size() > 0 &&
      next_at_ == Eigen::Map<const VectorXd>(x, variables())) {
    tracks_ = next_;
  }
  return 0;
}

}  // namespace phongpd::internal
