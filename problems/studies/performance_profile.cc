// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/performance_profile.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/mesh/counted.h"
#include "core/projection/phong_field.h"
#include "problems/output/step_figure.h"
#include "problems/output/text.h"
#include "problems/studies/trajectory_comparison.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

// The profile ends there.
constexpr double kLargest = 100.0;

StepCurve::Role RoleOf(const std::string& method) {
  if (method == "euclidean") return StepCurve::Role::kBaseline;
  return method == "phong@" + FormatDouble(kDefaultSmoothingLength)
             ? StepCurve::Role::kMain
             : StepCurve::Role::kOther;
}

int MostProblems(const std::vector<ProfileCurve>& curves) {
  int most = 0;
  for (const ProfileCurve& curve : curves) {
    most = std::max(most, curve.problems);
  }
  return most;
}

// With the number of its problems, where others were asked more.
std::string NameOf(const ProfileCurve& curve, int most) {
  return curve.problems == most
             ? curve.method
             : curve.method + " (" + std::to_string(curve.problems) + ")";
}

}  // namespace

std::string PerformanceProfile(const std::vector<Json>& rows,
                               const std::string& protocol,
                               const std::string& measure) {
  const std::vector<ProfileCurve> curves =
      ProfileCurves(rows, protocol, measure);
  const int most = MostProblems(curves);
  std::vector<StepCurve> steps;
  for (const ProfileCurve& curve : curves) {
    StepCurve step = {NameOf(curve, most), RoleOf(curve.method), {}};
    for (const double ratio : curve.ratios) {
      step.points.emplace_back(ratio, curve.Share(ratio));
    }
    steps.push_back(std::move(step));
  }
  StepFrame frame;
  frame.title = protocol + ", " + Counted(most, "problem") +
                "; higher and further left is better";
  frame.x = measure + " over the least of all methods'";
  frame.y = "share of problems solved";
  frame.most = kLargest;
  return StepFigure(steps, frame);
}

}  // namespace phongpd
