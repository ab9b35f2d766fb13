// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/approximation.h"

#include <algorithm>

namespace phongpd {
namespace {

constexpr ApproximationKind kKinds[] = {
    ApproximationKind::kAlphaWrap, ApproximationKind::kRobotHull,
    ApproximationKind::kDecimation, ApproximationKind::kOuterShell};

}  // namespace

const char* ApproximationName(ApproximationKind kind) {
  switch (kind) {
    case ApproximationKind::kAlphaWrap:
      return "alpha-wrap";
    case ApproximationKind::kRobotHull:
      return "robot-hull";
    case ApproximationKind::kDecimation:
      return "decimation";
    case ApproximationKind::kOuterShell:
      break;
  }
  return "outer-shell";
}

std::optional<ApproximationKind> FindApproximation(const std::string& name) {
  for (const ApproximationKind kind : kKinds) {
    if (name == ApproximationName(kind)) return kind;
  }
  return std::nullopt;
}

std::string KindsOf(const Approximation& approximation) {
  std::string joined;
  for (const ApproximationKind kind : kKinds) {
    const bool is_used = std::any_of(
        approximation.steps.begin(), approximation.steps.end(),
        [kind](const ApproximationStep& s) { return s.kind == kind; });
    if (!is_used) continue;
    if (!joined.empty()) joined += "+";
    joined += ApproximationName(kind);
  }
  return joined.empty() ? "none" : joined;
}

}  // namespace phongpd
