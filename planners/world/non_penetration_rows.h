// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

#include "constraints/non_penetration.h"
#include "planners/world/penetration_spec.h"
#include "planners/world/world.h"

namespace phongpd {

struct RowsOptions {
  int waypoints = 40;            // N ≥ 1, between start and goal
  std::optional<Length> margin;  // to keep, in (0, D]; none: DefaultMargin()
  PenetrationSpec penetration;   // inside obstacles
  // Interior samples of a segment; 0: by the Lipschitz rule.
  int samples_per_segment = 0;
  // h, user's unit: no segment is longer where samples are by the rule; 0:
  // kMaxSegmentRatio times those of the straight line.
  double max_segment = 0.0;
  int rows_per_sample = 1;  // in [1, 8]
};

// The rows d(sample) ≥ margin of a path in a world, for a solver of your own:
//
//   NonPenetrationRows rows(world, start, goal);
//   rows.Values(u, &g);  rows.Jacobian(u, &j);  // lower() ≤ g ≤ upper()
//   rows.Accept(u);                             // the solver's new iterate
//   if (!world.IsFree(rows.Path(u))) ...  // the judge has the last word
//
// Variables are the coordinates of the waypoints, x y z of one waypoint after
// the other.  Samples are the waypoints and interior points of every segment
// (NonPenetrationConstraint is the layer below).  If samples are by the rule,
// N+1 rows margin + h − |p_{i+1} − p_i| ≥ margin come last.  Then the motion is
// free if all rows hold, because both ends keep the margin and d is
// 1-Lipschitz. With a number of samples of your own nothing is known between
// them.
//
// A Phong depth follows a branch.  Branches are chosen at the first u that is
// asked for, and only Accept advances them: between two calls of Accept values
// are one smooth function.  So it is not thread-safe: use one object a solver.
class NonPenetrationRows {
 public:
  using Vector = Eigen::Ref<const Eigen::VectorXd>;

  // Builds the contact space of all obstacles unless the world has it.  Throws
  // InputError for options, and, with samples by the rule, if start or goal has
  // less room than the margin; and what World::Spaces throws.
  NonPenetrationRows(const World& world, const Eigen::Vector3d& start,
                     const Eigen::Vector3d& goal,
                     const RowsOptions& options = {});

  int variables() const { return rows_->variables(); }  // 3N
  int rows() const { return rows_->rows() + segment_rows(); }
  int nonzeros() const { return static_cast<int>(row_.size()); }
  double margin() const { return margin_; }  // user's unit
  double max_segment() const { return max_segment_; }
  int samples_per_segment() const { return samples_per_segment_; }
  // Of the rows: margin, and no limit above.
  Eigen::VectorXd lower() const;
  Eigen::VectorXd upper() const;
  // The pattern of the Jacobian, nonzeros() entries, zero-based; it never
  // changes.
  const std::vector<int>& row() const { return row_; }
  const std::vector<int>& column() const { return column_; }

  // The straight line: what a solver may begin with.
  Eigen::VectorXd StraightLine() const;
  // From start through the waypoints to goal, for the judge.
  std::vector<Eigen::Vector3d> Path(const Vector& u) const;

  // Branches of the least depth at u; forgets the others.
  void Start(const Vector& u);
  // u is the solver's new iterate: the branches follow it there.
  void Accept(const Vector& u);

  // Values, rows() of them, and derivatives by u: nonzeros() of them in the
  // order of the pattern, or as a matrix.  Arguments given by a pointer are
  // resized here.  All throw InputError for vectors of other sizes and for u
  // that is not finite.
  void Values(const Vector& u, Eigen::VectorXd* values);
  void Values(const Vector& u, Eigen::Ref<Eigen::VectorXd> values);
  void Entries(const Vector& u, Eigen::Ref<Eigen::VectorXd> entries);
  void Jacobian(const Vector& u, Eigen::SparseMatrix<double>* jacobian);
  // Both at once, for the price of one.
  void Evaluate(const Vector& u, Eigen::Ref<Eigen::VectorXd> values,
                Eigen::Ref<Eigen::VectorXd> entries);

 private:
  int segment_rows() const { return is_by_rule_ ? waypoints_ + 1 : 0; }
  void RequireRoomAtEnds(const FreeSpace& space) const;
  void RequireVariables(const Vector& u) const;
  Eigen::Vector3d Waypoint(int i, const Vector& u) const;
  void Query(const Vector& u, double* values, double* entries);

  const Eigen::Vector3d start_, goal_;
  const int waypoints_;
  double margin_ = 0.0, max_segment_ = 0.0;
  bool is_by_rule_ = false;
  int samples_per_segment_ = 0;
  std::unique_ptr<NonPenetrationConstraint> rows_;
  BranchSet branches_;
  std::vector<int> row_, column_;
};

}  // namespace phongpd
