// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/trajectory.h"
#include "planners/trajectory/curve_optimizer.h"

// What tests of curves in time ask about.
namespace phongpd::testing {

// Limits of 1, 2 and 10.
MotionLimits PlainLimits(bool by_norm = false);

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
