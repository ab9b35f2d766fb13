// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/non_penetration_rows.h"

#include <limits>
#include <utility>

#include "constraints/sampling_rule.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

void RequireSize(const char* what, Eigen::Index expected, Eigen::Index found) {
  if (found == expected) return;
  throw InputError(std::string(what) + ": expected " +
                   std::to_string(expected) + " numbers, found " +
                   std::to_string(found));
}

void RequireOptions(const Vector3d& start, const Vector3d& goal,
                    const RowsOptions& options) {
  if (!start.allFinite() || !goal.allFinite()) {
    throw InputError("start and goal: expected finite numbers, found others");
  }
  if (options.waypoints < 1) {
    throw InputError("waypoints: expected at least 1, found " +
                     std::to_string(options.waypoints));
  }
  if (options.samples_per_segment < 0) {
    throw InputError("samples_per_segment: expected at least 0, found " +
                     std::to_string(options.samples_per_segment));
  }
  const double longest = options.max_segment;
  if (longest >= 0.0 && longest <= std::numeric_limits<double>::max()) return;
  throw InputError("max_segment: expected a finite length ≥ 0, found " +
                   FormatDouble(longest));
}

}  // namespace

NonPenetrationRows::NonPenetrationRows(const World& world,
                                       const Vector3d& start,
                                       const Vector3d& goal,
                                       const RowsOptions& options)
    : start_(start), goal_(goal), waypoints_(options.waypoints) {
  RequireOptions(start, goal, options);
  const Length wanted = options.margin.value_or(DefaultMargin());
  RequireLength(wanted, LengthRange::kAboveZero, world.diagonal(), "margin",
                world.workspace().unit);
  margin_ = world.Resolve(wanted).unit;
  max_segment_ =
      options.max_segment > 0.0
          ? options.max_segment
          : kMaxSegmentRatio * (goal - start).norm() / (waypoints_ + 1);
  is_by_rule_ = options.samples_per_segment == 0;
  samples_per_segment_ = is_by_rule_ ? SamplesByRule(max_segment_, margin_)
                                     : options.samples_per_segment;
  const SignedMetricOptions metric =
      options.penetration.Options(world.diagonal());
  const WorldSpaces& built = world.Spaces(SpaceLayout::kMerged);
  if (is_by_rule_) RequireRoomAtEnds(*built.free_space);
  std::vector<std::shared_ptr<const SignedMetric>> metrics;
  for (const ContactSpace& space : built.spaces) {
    metrics.push_back(std::make_shared<SignedMetric>(space, metric));
  }
  rows_ = std::make_unique<NonPenetrationConstraint>(
      std::move(metrics), start, goal, waypoints_,
      std::vector<int>(static_cast<std::size_t>(waypoints_) + 1,
                       samples_per_segment_),
      options.rows_per_sample);
  row_.resize(static_cast<std::size_t>(rows_->nonzeros()));
  column_.resize(row_.size());
  rows_->Sparsity(row_.data(), column_.data());
  for (int i = 0; i < segment_rows(); ++i) {
    for (int end = i - 1; end <= i; ++end) {  // its free waypoints
      if (end < 0 || end == waypoints_) continue;
      for (int axis = 0; axis < 3; ++axis) {
        row_.push_back(rows_->rows() + i);
        column_.push_back(3 * end + axis);
      }
    }
  }
}

// Without that the rule says nothing of the first and last segment.
void NonPenetrationRows::RequireRoomAtEnds(const FreeSpace& space) const {
  for (const bool at_start : {true, false}) {
    const double room = space.Clearance(at_start ? start_ : goal_);
    if (room >= margin_) continue;
    throw InputError("margin: expected at most " + FormatDouble(room) +
                     "unit, the room of the " + (at_start ? "start" : "goal") +
                     ", found " + FormatDouble(margin_) +
                     "unit; less, or samples_per_segment of your own");
  }
}

void NonPenetrationRows::RequireVariables(const Vector& u) const {
  RequireSize("waypoints", variables(), u.size());
}

VectorXd NonPenetrationRows::lower() const {
  return VectorXd::Constant(rows(), margin_);
}

VectorXd NonPenetrationRows::upper() const {
  return VectorXd::Constant(rows(), std::numeric_limits<double>::infinity());
}

Vector3d NonPenetrationRows::Waypoint(int i, const Vector& u) const {
  if (i == 0) return start_;
  if (i > waypoints_) return goal_;
  return u.segment<3>(3 * (i - 1));
}

VectorXd NonPenetrationRows::StraightLine() const {
  VectorXd u(variables());
  for (int i = 0; i < waypoints_; ++i) {
    u.segment<3>(3 * i) =
        start_ + (i + 1.0) / (waypoints_ + 1.0) * (goal_ - start_);
  }
  return u;
}

std::vector<Vector3d> NonPenetrationRows::Path(const Vector& u) const {
  RequireVariables(u);
  std::vector<Vector3d> path;
  for (int i = 0; i <= waypoints_ + 1; ++i) path.push_back(Waypoint(i, u));
  return path;
}

void NonPenetrationRows::Start(const Vector& u) {
  RequireVariables(u);
  branches_ = rows_->Start(u.data(), nullptr);
}

void NonPenetrationRows::Accept(const Vector& u) {
  if (branches_.branches.empty()) Start(u);
  RequireVariables(u);
  rows_->Commit(u.data(), &branches_, nullptr);
}

void NonPenetrationRows::Query(const Vector& u, double* values,
                               double* entries) {
  if (branches_.branches.empty()) Start(u);
  RequireVariables(u);
  if (!rows_->Evaluate(u.data(), branches_, values, entries, nullptr)) {
    throw InputError("waypoints: expected finite numbers, found others");
  }
  if (values != nullptr) values += rows_->rows();
  if (entries != nullptr) entries += rows_->nonzeros();
  for (int i = 0; i < segment_rows(); ++i) {
    const Vector3d step = Waypoint(i + 1, u) - Waypoint(i, u);
    if (values != nullptr) *values++ = margin_ + max_segment_ - step.norm();
    if (entries == nullptr) continue;
    const Vector3d along = step.stableNormalized();  // 0 of 0
    for (const int end : {i, i + 1}) {
      if (end == 0 || end == waypoints_ + 1) continue;
      for (int axis = 0; axis < 3; ++axis) {
        *entries++ = end == i ? along[axis] : -along[axis];
      }
    }
  }
}

void NonPenetrationRows::Values(const Vector& u, VectorXd* values) {
  values->resize(rows());
  Query(u, values->data(), nullptr);
}

void NonPenetrationRows::Values(const Vector& u, Eigen::Ref<VectorXd> values) {
  RequireSize("values", rows(), values.size());
  Query(u, values.data(), nullptr);
}

void NonPenetrationRows::Entries(const Vector& u,
                                 Eigen::Ref<VectorXd> entries) {
  RequireSize("entries", nonzeros(), entries.size());
  Query(u, nullptr, entries.data());
}

void NonPenetrationRows::Evaluate(const Vector& u, Eigen::Ref<VectorXd> values,
                                  Eigen::Ref<VectorXd> entries) {
  RequireSize("values", rows(), values.size());
  RequireSize("entries", nonzeros(), entries.size());
  Query(u, values.data(), entries.data());
}

void NonPenetrationRows::Jacobian(const Vector& u,
                                  Eigen::SparseMatrix<double>* jacobian) {
  VectorXd entries(nonzeros());
  Entries(u, entries);
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(row_.size());
  for (int k = 0; k < nonzeros(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    triplets.emplace_back(row_[i], column_[i], entries[k]);
  }
  jacobian->resize(rows(), variables());
  jacobian->setFromTriplets(triplets.begin(), triplets.end());
}

}  // namespace phongpd
