// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "constraints/signed_metric.h"

namespace phongpd {

// The state of an evaluation: one branch for each sample and contact space, as
// NonPenetrationConstraint::Start makes it.  Every function that takes a set
// throws InputError if it has any other number of branches, or none.  Branches
// of another contact space are no error: a branch that cannot be continued is a
// cold query.
//
// Branches stay as they are while a solver tries points, and advance only at
// the iterates that it accepts (Commit): points that it rejects change nothing.
struct BranchSet {
  std::vector<Branch> branches;
  // How many ended inside at the last step and were replaced.
  long changes = 0;
};

struct NonPenetrationCounts {
  long cold = 0;            // queries without a branch
  long warm = 0;            // queries that followed one
  long branch_ends = 0;     // of the warm ones, those whose branch ended
  long branch_changes = 0;  // from one accepted iterate to the next
  long fallbacks = 0;       // inside without a Phong projection
};

// The solver's variables are u with q = center + unit·u; its rows are in
// multiples of `unit`.
struct PathFrame {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double unit = 1.0;
};

// The rows d(sample) ≥ margin of a polyline through N free waypoints,
//
//   start = p_0, p_1, …, p_N, p_{N+1} = goal,   variables u = (u_1, …, u_N),
//
// sampled at every free waypoint and at S_i interior points of each segment i,
// q = (1−t) p_i + t p_{i+1}, t = j/(S_i+1).  Start and goal are constants and
// have no rows.  The segment lengths are ≤ h, the metric is 1-Lipschitz: with
// h/(S_i+1) < 2·margin, and start and goal at least the margin away, no segment
// meets an obstacle when the rows hold.
//
// Rows are numbered sample by sample along the path (for each: space by space,
// row by row); entries row by row, waypoint by waypoint, x y z.  The pattern is
// fixed: it depends on N, S, K and the number of spaces only.  Const and
// thread-safe: what changes, branches and counts, is the caller's.
class NonPenetrationConstraint {
 public:
  // At least one metric, waypoints ≥ 1, N+1 sample counts ≥ 0, finite start
  // and goal, K = rows in [1, kMaxMetricRows] (of several contact spaces each
  // has K rows a sample), unit > 0.  Throws InputError.
  NonPenetrationConstraint(
      std::vector<std::shared_ptr<const SignedMetric>> metrics,
      const Eigen::Vector3d& start, const Eigen::Vector3d& goal, int waypoints,
      const std::vector<int>& samples_per_segment, int rows = 1,
      const PathFrame& frame = {});

  int variables() const { return 3 * waypoints_; }
  int samples() const { return static_cast<int>(samples_.size()); }
  int rows() const { return samples() * rows_per_sample_; }
  int nonzeros() const { return nonzeros_; }
  // The zero-based pattern, nonzeros() entries each.
  void Sparsity(int* row, int* col) const;

  // The configuration of a sample, user's unit.
  Eigen::Vector3d SamplePoint(int sample, const double* u) const;

  // rows() values (in units of `unit`) and nonzeros() derivatives by u, from
  // one set of queries; either may be null.  False, and nothing of use written,
  // if some u is not finite.  Does not allocate; counts may be null.  `next`,
  // of the same size and not `branches` itself, receives the branches as Commit
  // would advance them to u; null: they are not wanted.
  bool Evaluate(const double* u, const BranchSet& branches, double* values,
                double* jacobian, NonPenetrationCounts* counts,
                BranchSet* next = nullptr) const;

  // Cold branches at u: the beginning of a solve or of a round.
  BranchSet Start(const double* u, NonPenetrationCounts* counts) const;
  // u was accepted: advances the branches to it.  Does nothing if some u is not
  // finite.
  void Commit(const double* u, BranchSet* branches,
              NonPenetrationCounts* counts) const;

 private:
  struct Sample {
    int segment = 0;
    double t = 0.0;              // 0: the waypoint p_segment itself
    int waypoint[2] = {-1, -1};  // free waypoints 0 … N−1 it depends on
    double weight[2] = {0.0, 0.0};
    int count = 0;
  };

  Eigen::Vector3d Waypoint(int index, const double* u) const;
  // visit(sample, row) for all rows in their order.
  template <typename Visit>
  void ForEachRow(const double* u, const BranchSet& branches,
                  NonPenetrationCounts* counts, BranchSet* next,
                  const Visit& visit) const;
  bool IsFinite(const double* u) const;
  void CheckSize(const BranchSet& branches) const;
  std::size_t BranchIndex(int sample, std::size_t space) const {
    return static_cast<std::size_t>(sample) * metrics_.size() + space;
  }

  std::vector<std::shared_ptr<const SignedMetric>> metrics_;
  Eigen::Vector3d start_, goal_;
  int waypoints_ = 0;
  int rows_per_space_ = 1;  // K
  PathFrame frame_;
  int rows_per_sample_ = 1;  // K, or K times the number of spaces
  int nonzeros_ = 0;
  std::vector<Sample> samples_;
};

}  // namespace phongpd
