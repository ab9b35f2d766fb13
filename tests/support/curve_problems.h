// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>
#include <string>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/trajectory.h"
#include "core/contact/contact_space.h"
#include "planners/trajectory/curve_optimizer.h"

// What tests of curves in time ask about.
namespace phongpd::testing {

// Limits of 1, 2 and 10.
MotionLimits PlainLimits(bool by_norm = false);

// A cube of side 0.5 over one of 1.5 is in contact at |q|∞ = 1.  Over the
// cube at height z(s) = 1 + gap + (2s − 1)², exact where gap + 2 is.
Trajectory Arch(double gap);

// Starts free; each point is `spread` of the contact space's diagonal from the
// one before it, in the standard deviation of each coordinate: hits, misses
// and near misses.
CurvePiece RandomPiece(const FreeSpace& space, const ContactSpace& contact,
                       double spread, std::mt19937_64* random);

// Comes as near as `gap` to a random point of the surface, and leaves:
// x + gap n + u s + k s² n, s ∈ [−1, 1].
CurvePiece GrazingPiece(const ContactSpace& contact, double gap,
                        std::mt19937_64* random);

// Families of PathProblem that differ in what is hard for curves.
const std::vector<std::string>& CurveFamilies();

// A free path, planned, among the obstacles of a PathProblem.
struct FreePath {
  FreeSpace space;
  double diagonal;
  std::vector<Eigen::Vector3d> path;
};
FreePath PlanFreePath(const std::string& family, std::uint64_t seed);

// What OptimizeCurve promises of every curve near a path: free and within the
// limits for all t by the judges, from end to end, of class C² for PlainLimits,
// and no slower than the stops that it began with.
void ExpectCertified(const FreeSpace& space,
                     const std::vector<Eigen::Vector3d>& path,
                     const MotionLimits& limits, const CurveSummary& summary);

}  // namespace phongpd::testing
