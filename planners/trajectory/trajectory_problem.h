// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/sampling_rule.h"
#include "constraints/signed_metric.h"

namespace phongpd {

// A polyline of N free waypoints between fixed ends,
//
//   start = p_0, p_1, …, p_N, p_{N+1} = goal,
//
// that minimises the energy
//
//   f = (N+1)/ℓ₀² · Σ |p_{i+1} − p_i|²,   ℓ₀ = max(|goal − start|, 1e-3 D),
//
// (the evenly spaced straight line has f = 1) subject to d(sample) ≥ margin·D
// at the waypoints and S interior samples of each segment, and to
// |p_{i+1} − p_i| ≤ h = ρ L/(N+1).  D is the diagonal, L the larger of
// |goal − start| and the length of the path the solver starts from.
//
// d is 1-Lipschitz, so with  S + 1 > h/(2·margin·D)  and both ends at least
// the margin away no segment can touch an obstacle: the rule S is chosen by.
// The answer is judged exactly all the same.
struct TrajectoryProblem {
  // One per contact space, or one for the merged one; none: no obstacle.
  std::vector<std::shared_ptr<const SignedMetric>> metrics;
  // The judge, of the same contact spaces.  Its bounds, if any, bound the
  // waypoints.
  std::shared_ptr<const FreeSpace> free_space;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  int waypoints = 40;           // N in [1, 10000]
  int samples_per_segment = 0;  // S in [0, 1000]; 0: by the rule
  double margin = 0.01;         // fraction of D, in [0, 1]
  double max_segment_ratio = kMaxSegmentRatio;  // ρ ≥ 1
  // D, user's unit; 0: that of the contact spaces (WithCommonLength).
  double diagonal = 0.0;

  // Throws InputError naming the field.
  void Validate() const;
};

using Path = std::vector<Eigen::Vector3d>;

// The contact spaces with one metric each and their judge, all with one D
// (WithCommonLength); only start and goal are left to set.  Throws InputError
// as SignedMetric and FreeSpace do.
TrajectoryProblem MakeTrajectoryProblem(
    const std::vector<ContactSpace>& contact_spaces,
    const SignedMetricOptions& metric = {},
    const BoundingBox& bounds = FreeSpace::NoBounds());

// D of the problem, user's unit; > 0.
double Diagonal(const TrajectoryProblem& problem);

// f of a path, with the problem's ℓ₀ and N+1 the number of its segments.
double PathEnergy(const TrajectoryProblem& problem, const Path& path);

// Throws InputError unless `path` has N+2 finite points, the problem's start
// and goal at its ends.
void CheckStartPath(const TrajectoryProblem& problem, const Path& path);

// N+2 evenly spaced points from start to goal.
Path StraightPath(const TrajectoryProblem& problem);

// h = ρ L/(N+1) for a start path of that length.
double MaxSegment(const TrajectoryProblem& problem, double start_length);

// The least S by the rule, at most 1000 (where the certificate is lost and
// only the judge is left); the problem's own S if it sets one.  0 where
// margin = 0: no number of samples would do.
int SamplesPerSegment(const TrajectoryProblem& problem, double start_length);

}  // namespace phongpd
