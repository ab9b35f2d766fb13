// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/moving_judge.h"

#include <algorithm>

#include "constraints/relative_motion.h"

namespace phongpd {
namespace {

// Of hulls, a relative motion.
constexpr long kMostTests = 1'000'000;

}  // namespace

MovingCheck CheckAgainst(const std::vector<MovingBody>& bodies,
                         const Trajectory& curve, double begin, double until,
                         double clearance) {
  MovingCheck result;
  result.verdict = MotionVerdict::kFree;
  result.free_until = result.time = until;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    // What comes after the first meeting does not matter.
    const double span = result.IsFree() ? until : result.free_until;
    if (!(span > 0.0)) break;
    const RelativeMotion seen =
        RelativeMotionOf(curve, bodies[i].motion, span, begin);
    const CurveCheck check = CheckCurve(*bodies[i].space, seen.curve,
                                        kMostTests, seen.rounding + clearance);
    result.tests += check.tests;
    if (check.IsFree()) continue;
    result.verdict = check.verdict;
    result.free_until = std::min(check.free_until, span);
    result.time = std::min(check.time, span);
    result.body = static_cast<int>(i);
    result.configuration = curve.At(result.time).position;
  }
  return result;
}

MovingCheck CheckCurveAmong(const FreeSpace& fixed,
                            const std::vector<MovingBody>& bodies,
                            const Trajectory& curve, double clearance) {
  const CurveCheck still = CheckCurve(fixed, curve, kMostTests, clearance);
  MovingCheck result;
  result.verdict = still.verdict;
  result.free_until = still.free_until;
  result.time = still.time;
  result.configuration = still.configuration;
  result.tests = still.tests;
  if (curve.empty() || bodies.empty()) return result;
  // What comes after the first meeting does not matter.
  const double until = still.IsFree()
                           ? std::max(curve.duration(), LastMotion(bodies))
                           : still.free_until;
  if (!(until > 0.0)) return result;
  const MovingCheck moving = CheckAgainst(bodies, curve, 0.0, until, clearance);
  result.tests += moving.tests;
  if (moving.IsFree()) return result;
  const long tests = result.tests;
  result = moving;
  result.tests = tests;
  return result;
}

double ProvedClearance(const FreeSpace& fixed,
                       const std::vector<MovingBody>& bodies,
                       const Trajectory& curve, double at_most) {
  const auto keeps = [&](double clearance) {
    return CheckCurveAmong(fixed, bodies, curve, clearance).IsFree();
  };
  if (!(at_most > 0.0) || curve.empty()) return 0.0;
  if (keeps(at_most)) return at_most;
  double low = 0.5 * at_most;
  while (!keeps(low)) {
    low *= 0.5;
    if (low < 0x1p-20 * at_most) return 0.0;
  }
  double high = 2.0 * low;
  for (int i = 0; i < 3; ++i) {
    const double middle = 0.5 * (low + high);
    (keeps(middle) ? low : high) = middle;
  }
  return low;
}

double LastMotion(const std::vector<MovingBody>& bodies) {
  double last = 0.0;
  for (const MovingBody& body : bodies) {
    last = std::max(last, body.motion.duration());
  }
  return last;
}

}  // namespace phongpd
