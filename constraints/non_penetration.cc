// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/non_penetration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

void Fail(const std::string& what, const std::string& found) {
  throw InputError("non-penetration constraint: " + what + ", found " + found);
}

bool IsChanged(const MetricRow& row, bool was_warm) {
  return was_warm && row.inside && row.status == QueryStatus::kBranchEnded;
}

void Count(const MetricRow& row, bool was_warm, NonPenetrationCounts* counts) {
  if (counts == nullptr) return;
  ++(was_warm ? counts->warm : counts->cold);
  counts->branch_ends += row.status == QueryStatus::kBranchEnded ? 1 : 0;
  counts->fallbacks += row.status == QueryStatus::kEuclideanFallback ? 1 : 0;
}

}  // namespace

NonPenetrationConstraint::NonPenetrationConstraint(
    std::vector<std::shared_ptr<const SignedMetric>> metrics,
    const Vector3d& start, const Vector3d& goal, int waypoints,
    const std::vector<int>& samples_per_segment, int rows,
    const PathFrame& frame)
    : metrics_(std::move(metrics)),
      start_(start),
      goal_(goal),
      waypoints_(waypoints),
      rows_per_space_(rows),
      frame_(frame) {
  if (metrics_.empty()) Fail("needs at least one contact space", "none");
  for (const auto& metric : metrics_) {
    if (metric == nullptr) Fail("needs a metric for each space", "a null one");
  }
  if (rows < 1 || rows > kMaxMetricRows) {
    Fail("rows must be 1 to " + std::to_string(kMaxMetricRows),
         std::to_string(rows));
  }
  if (waypoints < 1) {
    Fail("needs at least one free waypoint", std::to_string(waypoints));
  }
  if (static_cast<int>(samples_per_segment.size()) != waypoints + 1) {
    Fail("needs " + std::to_string(waypoints + 1) + " sample counts",
         std::to_string(samples_per_segment.size()));
  }
  if (!phongpd::IsFinite(start) || !phongpd::IsFinite(goal)) {
    Fail("start and goal must be finite", "NaN or Inf");
  }
  if (!(frame_.unit > 0.0) || !std::isfinite(frame_.unit) ||
      !phongpd::IsFinite(frame_.center)) {
    Fail("the frame needs a finite centre and a unit > 0",
         std::to_string(frame_.unit));
  }
  rows_per_sample_ = rows * static_cast<int>(metrics_.size());
  for (int i = 0; i <= waypoints_; ++i) {
    const int count = samples_per_segment[static_cast<std::size_t>(i)];
    if (count < 0) Fail("sample counts must be ≥ 0", std::to_string(count));
    // Point 0 of a segment is its first waypoint.
    for (int j = i == 0 ? 1 : 0; j <= count; ++j) {
      Sample sample;
      sample.segment = i;
      sample.t = static_cast<double>(j) / (count + 1);
      if (i > 0) {
        sample.waypoint[sample.count] = i - 1;
        sample.weight[sample.count++] = 1.0 - sample.t;
      }
      if (i < waypoints_ && j > 0) {
        sample.waypoint[sample.count] = i;
        sample.weight[sample.count++] = sample.t;
      }
      nonzeros_ += 3 * sample.count * rows_per_sample_;
      samples_.push_back(sample);
    }
  }
}

void NonPenetrationConstraint::Sparsity(int* row, int* col) const {
  int r = 0;
  for (const Sample& sample : samples_) {
    for (int k = 0; k < rows_per_sample_; ++k, ++r) {
      for (int i = 0; i < 3 * sample.count; ++i) {
        *row++ = r;
        *col++ = 3 * sample.waypoint[i / 3] + i % 3;
      }
    }
  }
}

Vector3d NonPenetrationConstraint::Waypoint(int index, const double* u) const {
  if (index == 0) return start_;
  if (index == waypoints_ + 1) return goal_;
  const double* p = u + 3 * (index - 1);
  return frame_.center + frame_.unit * Vector3d(p[0], p[1], p[2]);
}

Vector3d NonPenetrationConstraint::SamplePoint(int sample,
                                               const double* u) const {
  const Sample& s = samples_[static_cast<std::size_t>(sample)];
  const Vector3d a = Waypoint(s.segment, u);
  if (s.t == 0.0) return a;
  return (1.0 - s.t) * a + s.t * Waypoint(s.segment + 1, u);
}

bool NonPenetrationConstraint::IsFinite(const double* u) const {
  // Sums of a few numbers far below the largest double stay finite.
  constexpr double kLargest = std::numeric_limits<double>::max() / 16.0;
  const double limit = kLargest / std::max(1.0, frame_.unit);
  return std::all_of(u, u + variables(), [&](double x) {
    return std::islessequal(std::abs(x), limit);
  });
}

void NonPenetrationConstraint::CheckSize(const BranchSet& branches) const {
  const std::size_t expected = samples_.size() * metrics_.size();
  if (branches.branches.size() == expected) return;
  Fail("needs the branches Start makes for it, " + std::to_string(expected) +
           " (" + std::to_string(samples_.size()) + " samples × " +
           std::to_string(metrics_.size()) + " contact spaces)",
       std::to_string(branches.branches.size()));
}

template <typename Visit>
void NonPenetrationConstraint::ForEachRow(const double* u,
                                          const BranchSet& branches,
                                          NonPenetrationCounts* counts,
                                          BranchSet* next,
                                          const Visit& visit) const {
  const auto count = static_cast<std::size_t>(rows_per_space_);
  std::array<MetricRow, kMaxMetricRows> rows;  // of one space
  for (int s = 0; s < samples(); ++s) {
    const Sample& sample = samples_[static_cast<std::size_t>(s)];
    const Vector3d q = SamplePoint(s, u);
    for (std::size_t m = 0; m < metrics_.size(); ++m) {
      const Branch& previous = branches.branches[BranchIndex(s, m)];
      metrics_[m]->Query(q, previous, rows_per_space_, rows.data());
      Count(rows[0], previous.IsValid(), counts);
      if (next != nullptr) {
        next->branches[BranchIndex(s, m)] = rows[0].branch;
        next->changes += IsChanged(rows[0], previous.IsValid()) ? 1 : 0;
      }
      for (std::size_t k = 0; k < count; ++k) visit(sample, rows[k]);
    }
  }
}

bool NonPenetrationConstraint::Evaluate(const double* u,
                                        const BranchSet& branches,
                                        double* values, double* jacobian,
                                        NonPenetrationCounts* counts,
                                        BranchSet* next) const {
  CheckSize(branches);
  if (next != nullptr) CheckSize(*next);
  if (!IsFinite(u)) return false;
  if (next != nullptr) next->changes = 0;
  ForEachRow(u, branches, counts, next,
             [&](const Sample& sample, const MetricRow& row) {
               if (values != nullptr) {
                 *values++ = std::min(row.value / frame_.unit,
                                      std::numeric_limits<double>::max());
               }
               if (jacobian == nullptr) return;
               for (int i = 0; i < sample.count; ++i) {
                 for (int axis = 0; axis < 3; ++axis) {
                   *jacobian++ = sample.weight[i] * row.gradient[axis];
                 }
               }
             });
  return true;
}

BranchSet NonPenetrationConstraint::Start(const double* u,
                                          NonPenetrationCounts* counts) const {
  BranchSet set;
  set.branches.resize(samples_.size() * metrics_.size());
  if (!IsFinite(u)) return set;
  for (int s = 0; s < samples(); ++s) {
    const Vector3d q = SamplePoint(s, u);
    for (std::size_t m = 0; m < metrics_.size(); ++m) {
      const MetricRow row = metrics_[m]->Query(q);
      Count(row, false, counts);
      set.branches[BranchIndex(s, m)] = row.branch;
    }
  }
  return set;
}

void NonPenetrationConstraint::Commit(const double* u, BranchSet* branches,
                                      NonPenetrationCounts* counts) const {
  CheckSize(*branches);
  if (!IsFinite(u)) return;
  branches->changes = 0;
  for (int s = 0; s < samples(); ++s) {
    const Vector3d q = SamplePoint(s, u);
    for (std::size_t m = 0; m < metrics_.size(); ++m) {
      Branch& branch = branches->branches[BranchIndex(s, m)];
      const bool was_warm = branch.IsValid();
      const MetricRow now = metrics_[m]->Query(q, branch);
      Count(now, was_warm, counts);
      branches->changes += IsChanged(now, was_warm) ? 1 : 0;
      branch = now.branch;
    }
  }
  if (counts != nullptr) counts->branch_changes += branches->changes;
}

}  // namespace phongpd
