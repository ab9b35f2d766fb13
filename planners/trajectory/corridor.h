// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "planners/trajectory/ipopt_solve.h"
#include "planners/trajectory/path_history.h"
#include "planners/trajectory/trajectory_problem.h"
#include "planners/world/path_status.h"

namespace phongpd {

// τ of the first round, a share of D.
inline constexpr double kFirstTrust = 0.05;

using CorridorStatus = PathStatus;  // old name, removed in 0.3

struct CorridorRound {
  double objective = 0.0;  // after the round, of the path kept
  double missing = 0.0;    // clearance that is missing, sum over segments, in D
  double trust = 0.0;      // τ, in D
  int planes = 0;
  int iterations = 0;
  bool is_accepted = false;
};

struct CorridorSummary {
  PathStatus status = PathStatus::kNotFree;
  Path path;               // exactly free, except for kNotFree
  double objective = 0.0;  // energy of `path`
  // The smaller of the margin and the path's distance from contact, in D.
  double clearance = 0.0;
  int iterations = 0;  // of Ipopt, all rounds
  std::vector<CorridorRound> rounds;
  double seconds = 0.0;

  bool IsFree() const { return status != PathStatus::kNotFree; }
  // Is the path a local minimum?  (False if the start path was kept only
  // because rounding let no improvement pass.)
  bool HasConverged() const;
};

// Shortens an exactly free path without ever leaving free space: a sequence of
// convex programs in corridors of planes.  No penetration metric is used.  Each
// round:
//
//  1. For each segment, planes are put between it and the triangles within
//     2τ + margin, the nearest triangle first: through its point closest to the
//     segment, orthogonal to the line between the closest points.  It separates
//     the two, because both are convex.  A triangle that is already behind a
//     plane needs none.
//  2. The convex program in the waypoints p and the missing clearances s,
//
//       min  f(p) + (P/ℓ₀) Σ s_i
//       s.t. n·p ≥ level + wanted_i − s_i  for its planes and both its ends
//            0 ≤ s_i ≤ wanted_i − clearance_i of segment i now (or fixed at 0)
//            |p − p_now|_∞ ≤ τ,  |Δp| ≤ h,
//
//     is solved by Ipopt.  f, ℓ₀, D and h are those of TrajectoryProblem; P is
//     50; wanted_i is the margin, or between opposite planes 0.95 of half the
//     gap if that is less.
//  3. The step is kept if the exact judge finds it free, and the merit (the
//     same objective with the true missing clearances) fell.  Ipopt's claim
//     does not count.  Otherwise τ is halved.
//
// So every path that is kept is exactly free.  Missing clearance is restored
// where a passage allows it, and a segment loses wanted clearance only for
// another one's.  Once none is missing, f falls monotonically.  The result is a
// local minimum: it passes obstacles on the same side as the start path.
//
// `path` has N + 2 points from start to goal; throws InputError for another
// shape, and for a time limit (seconds) that is not > 0.  problem.metrics are
// not used.  on_path is called with every iterate of every round.
CorridorSummary PolishInCorridor(
    const TrajectoryProblem& problem, const Path& path,
    double time_limit = std::numeric_limits<double>::infinity(),
    const PathObserver& on_path = {});

// A plane between a segment of a path and what is near it: all of the segment
// is `distance` above it, the obstacle there below.  User's unit.
struct CorridorPlane {
  int segment = 0;                                   // point k → point k + 1
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, to the segment
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   // below its lowest point
  double distance = 0.0;
};

// The planes that a round of PolishInCorridor would put around an exactly free
// path, its answer for example: those within 2τ + margin, τ = kFirstTrust.
// Empty for a path that collides.  Throws like PolishInCorridor.
std::vector<CorridorPlane> PlanesAround(const TrajectoryProblem& problem,
                                        const Path& path);

// The most that a segment of an exactly free path lacks of the clearance it
// could have, which is `wanted` above: the margin where there is room for it.
// Fraction of the margin, in [0, 1]; 0 where the margin is 0.  Two paths are
// to be compared by their length only if they keep equally clear.
double MissingClearance(const TrajectoryProblem& problem, const Path& path);
// So much does not count: what samples leave open between them.
inline constexpr double kToleratedMissing = 0.1;

}  // namespace phongpd
