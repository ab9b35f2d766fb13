// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/sampling_rule.h"
#include "constraints/signed_metric.h"

namespace phongpd {

class World;

// A polyline of N free waypoints between fixed ends,
//
//   start = p_0, p_1, …, p_N, p_{N+1} = goal,
//
// that minimises the energy
//
//   f = (N+1)/ℓ₀² · Σ |p_{i+1} − p_i|²,   ℓ₀ = max(|goal − start|, 1e-3 D),
//
// (f = 1 for the straight line with even segments), subject to two kinds of
// rows: d(sample) ≥ margin·D at the waypoints and at S samples inside each
// segment, and |p_{i+1} − p_i| ≤ h = ρ L/(N+1).  D is the diagonal.  L is the
// larger of |goal − start| and the length of the path the solver starts from.
//
// d is 1-Lipschitz.  So if S + 1 > h/(2·margin·D), and both ends keep the
// margin, no segment can touch an obstacle; S is chosen by this rule.  The
// answer is judged exactly all the same.
struct TrajectoryProblem {
  // One per contact space; empty: no obstacle.
  std::vector<std::shared_ptr<const SignedMetric>> metrics;
  // The judge, with the same contact spaces.  If it has bounds, they bound the
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

// A problem of these contact spaces: with a metric for each, a judge, and one
// common D (WithCommonLength).  Then set start and goal.  Throws InputError
// like SignedMetric and FreeSpace.
TrajectoryProblem MakeTrajectoryProblem(
    const std::vector<ContactSpace>& contact_spaces,
    const SignedMetricOptions& metric = {},
    const BoundingBox& bounds = FreeSpace::NoBounds());

// The same of a world: its obstacles as one contact space, which is built on
// first use, its bounds and its D.  Throws what World::Spaces throws, too.
TrajectoryProblem TrajectoryProblemIn(const World& world,
                                      const SignedMetricOptions& metric = {});

// D of the problem, user's unit; > 0.
double Diagonal(const TrajectoryProblem& problem);

// f of a path, with the problem's ℓ₀ and N+1 the number of its segments.
double PathEnergy(const TrajectoryProblem& problem, const Path& path);

// Throws InputError unless `path` has N+2 finite points, and begins at the
// problem's start and ends at its goal.
void CheckStartPath(const TrajectoryProblem& problem, const Path& path);

// N+2 evenly spaced points from start to goal.
Path StraightPath(const TrajectoryProblem& problem);

// h = ρ L/(N+1) for a start path of that length.
double MaxSegment(const TrajectoryProblem& problem, double start_length);

// S: the problem's own if it is set; otherwise the least by the rule, but at
// most 1000.  (With more needed, samples prove nothing, and only the judge
// does.)  0 if margin = 0, because then no number of samples is enough.
int SamplesPerSegment(const TrajectoryProblem& problem, double start_length);

}  // namespace phongpd
