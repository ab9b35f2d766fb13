// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/verification.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "constraints/motion_oracle.h"
#include "core/mesh/finite.h"
#include "core/solid/solid.h"
#include "core/stopwatch.h"
#include "planners/exact/curve_verification.h"
#include "planners/exact/separating_part.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// A segment that is not free after one displacement is halved this often.
constexpr int kHalvings = 6;
constexpr std::size_t kSamples = 500;
// Of the diagonal: what a depth may be short of.
constexpr double kDepthTolerance = 1e-9;
// From one step away from the surface to the next.
constexpr double kShorter = 0.125;

std::string Text(const Vector3d& q) {
  std::string text = "(";
  for (int k = 0; k < 3; ++k) {
    text += (k == 0 ? "" : ", ") + std::to_string(q[k]);
  }
  return text + ")";
}

Verification Answer(Verdict verdict, const std::string& reason) {
  Verification answer;
  answer.verdict = verdict;
  answer.reason = reason;
  return answer;
}

// The 26 directions to the neighbours of a lattice point, and none.
const std::vector<Vector3d>& Directions() {
  static const std::vector<Vector3d> directions = [] {
    std::vector<Vector3d> all = {Vector3d::Zero()};
    for (int k = 0; k < 27; ++k) {
      const Vector3d v(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      if (k != 13) all.push_back(v.normalized());
    }
    return all;
  }();
  return directions;
}

double HalfLongestSide(const BoundingBox& box) {
  return 0.5 * (box.max - box.min).maxCoeff();
}
double LargestCoordinate(const BoundingBox& box) {
  return box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
}

}  // namespace

const char* ToString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kConfirmed:
      return "confirmed";
    case Verdict::kWithinRounding:
      return "within_rounding";
    case Verdict::kUndecided:
      return "undecided";
    case Verdict::kRefuted:
      break;
  }
  return "refuted";
}

struct Verifier::Impl {
  bool IsWithinBounds(const Vector3d& q) const {
    return bounds.IsEmpty() || ((q.array() > bounds.min.array()).all() &&
                                (q.array() < bounds.max.array()).all());
  }
  bool Touches(const Vector3d& a, const Vector3d& b, long* tests) const {
    ++*tests;
    return oracle && oracle->Collides(a, b);
  }
  // The bounds are convex: their ends tell.
  bool IsFree(const Vector3d& a, const Vector3d& b, long* tests) const {
    return IsWithinBounds(a) && IsWithinBounds(b) && !Touches(a, b, tests);
  }

  // Is every point of the segment within `rounding` of a free place?
  bool IsNearlyFree(const Vector3d& a, const Vector3d& b, int halvings,
                    long* tests) const {
    for (const double share : {1.0, 0.25}) {
      for (const Vector3d& direction : Directions()) {
        const Vector3d v = share * rounding * direction;
        if (IsFree(a + v, b + v, tests)) return true;
      }
    }
    if (halvings == 0 || a == b) return false;
    const Vector3d middle = 0.5 * a + 0.5 * b;
    return IsNearlyFree(a, middle, halvings - 1, tests) &&
           IsNearlyFree(middle, b, halvings - 1, tests);
  }

  bool IsNearlyBlocked(const Vector3d& q, long* tests) const {
    return std::any_of(Directions().begin(), Directions().end(),
                       [&](const Vector3d& direction) {
                         const Vector3d x = q + rounding * direction;
                         return !IsFree(x, x, tests);
                       });
  }

  // δ of the contracts.
  double Tolerance() const {
    return kDepthTolerance * diagonal + 2.0 * rounding;
  }

  // Is the robot free at x + s n, or in contact at x − s n, for a step s ≤ δ,
  // or else so at δ in another direction?  A step passes through what is
  // thinner; a shorter one that shows the surface shows it nearer to x.
  Verdict Beside(const Vector3d& x, const Vector3d& n, double delta,
                 bool wants_free, long* tests) const {
    for (double step = delta; step >= least_step; step *= kShorter) {
      const Vector3d beside = x + (wants_free ? step : -step) * n;
      if (Touches(beside, beside, tests) != wants_free) {
        return Verdict::kConfirmed;
      }
    }
    for (const Vector3d& direction : Directions()) {
      const Vector3d other = x + delta * direction;
      if (Touches(other, other, tests) != wants_free) {
        return Verdict::kWithinRounding;
      }
    }
    return Verdict::kRefuted;
  }

  std::string Where(const Vector3d& a, const Vector3d& b,
                    std::size_t segment) const {
    const std::string at = "segment " + std::to_string(segment);
    if (!IsWithinBounds(a) || !IsWithinBounds(b)) {
      return at + " is not strictly within the bounds";
    }
    const MotionMeeting meeting = oracle->FirstMeeting(a, b);
    return at + " collides" + WithObstacle(meeting) + " at fraction " +
           std::to_string(meeting.fraction);
  }

  std::string WithObstacle(const MotionMeeting& meeting) const {
    if (meeting.obstacle_triangle < 0) return "";
    std::size_t i = 0;
    while (i + 1 < first_triangle.size() &&
           meeting.obstacle_triangle >= first_triangle[i + 1]) {
      ++i;
    }
    return " with obstacle '" + names[i] + "'";
  }

  std::optional<MotionOracle> oracle;  // none: no obstacle
  std::vector<std::string> names;
  std::vector<int> first_triangle;  // of each obstacle, in the joined mesh
  BoundingBox bounds;
  double rounding = 0.0;
  double least_step = 0.0;  // that the rounding of points to doubles leaves
  double diagonal = 0.0;    // of the contact space
};

Verifier::Verifier(const Workspace& workspace)
    : impl_(std::make_unique<Impl>()) {
  workspace.Validate();
  Impl& impl = *impl_;
  impl.bounds = workspace.bounds;
  // All of them: that some are out of reach is the planner's own finding.
  const Solid all = JoinedSolids(workspace.obstacles, "obstacles");
  int triangles = 0;
  for (const Solid& obstacle : workspace.obstacles) {
    impl.names.push_back(obstacle.name());
    impl.first_triangle.push_back(triangles);
    triangles += static_cast<int>(obstacle.mesh().triangles.size());
  }
  const BoundingBox robot = ComputeBounds(workspace.robot);
  BoundingBox operand = robot;
  if (!all.IsEmpty()) {
    impl.oracle.emplace(workspace.robot, all);
    operand = ComputeBounds(all);
    impl.diagonal =
        ((operand.max - robot.min) - (operand.min - robot.max)).norm();
  }
  double largest = LargestCoordinate(robot) + LargestCoordinate(operand);
  double reach = std::max(HalfLongestSide(robot), HalfLongestSide(operand));
  if (!impl.bounds.IsEmpty()) {
    const BoundingBox shell = ComputeBounds(BoundsShell(workspace));
    reach = std::max(reach, HalfLongestSide({shell.min.cwiseMin(operand.min),
                                             shell.max.cwiseMax(operand.max)}));
    largest += LargestCoordinate(shell);
  }
  impl.least_step = 0x1p-48 * largest;
  impl.rounding = 0x1p-35 * reach + impl.least_step;
}

Verifier::~Verifier() = default;
Verifier::Verifier(Verifier&&) noexcept = default;
Verifier& Verifier::operator=(Verifier&&) noexcept = default;

double Verifier::rounding() const { return impl_->rounding; }

Verification Verifier::VerifyPath(const std::vector<Vector3d>& path) const {
  const Stopwatch stopwatch;
  Verification result;
  if (path.empty()) return Answer(Verdict::kRefuted, "the path has no point");
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Vector3d& a = path[k];
    const Vector3d& b = path[std::min(k + 1, path.size() - 1)];
    if (k + 1 == path.size() && k > 0) break;
    if (!IsFinite(a) || !IsFinite(b)) {
      result.verdict = Verdict::kRefuted;
      result.reason = "segment " + std::to_string(k) + " is not finite";
      break;
    }
    if (impl_->IsFree(a, b, &result.tests)) continue;
    const bool is_close = impl_->IsNearlyFree(a, b, kHalvings, &result.tests);
    if (result.reason.empty() || !is_close) {
      result.reason = impl_->Where(a, b, k) +
                      (is_close ? ", by less than the rounding" : "");
    }
    result.verdict = is_close ? Verdict::kWithinRounding : Verdict::kRefuted;
    if (!is_close) break;
  }
  result.seconds = stopwatch.Seconds();
  return result;
}

Verification Verifier::VerifyCurve(const Trajectory& curve) const {
  const Stopwatch stopwatch;
  if (curve.empty()) return Answer(Verdict::kRefuted, "the curve has no piece");
  const Impl& impl = *impl_;
  internal::CurveGround ground;
  ground.oracle = impl.oracle ? &*impl.oracle : nullptr;
  ground.bounds = impl.bounds;
  ground.rounding = impl.rounding;
  ground.least_step = impl.least_step;
  ground.directions = &Directions();
  ground.name_obstacle = [&](const Vector3d& q) {
    return impl.oracle ? impl.WithObstacle(impl.oracle->FirstMeeting(q, q))
                       : std::string();
  };
  Verification result = internal::VerifyCurve(ground, curve);
  result.seconds = stopwatch.Seconds();
  return result;
}

Verification Verifier::VerifyBlocked(const Vector3d& q) const {
  const Stopwatch stopwatch;
  Verification result;
  if (IsFinite(q) && impl_->IsFree(q, q, &result.tests)) {
    const bool is_close = impl_->IsNearlyBlocked(q, &result.tests);
    result.verdict = is_close ? Verdict::kWithinRounding : Verdict::kRefuted;
    result.reason = "the robot is free at " + Text(q) +
                    (is_close ? ", by less than the rounding" : "");
  }
  result.seconds = stopwatch.Seconds();
  return result;
}

Verification Verifier::VerifySeparation(const TriangleMesh& contact_mesh,
                                        const Vector3d& start,
                                        const Vector3d& goal) const {
  const Stopwatch stopwatch;
  Verification result;
  const std::vector<int> separating =
      FindSeparatingPart(contact_mesh, start, goal);
  if (separating.empty()) {
    result.verdict = Verdict::kRefuted;
    result.reason =
        "no closed part of the contact space separates start and goal";
    result.seconds = stopwatch.Seconds();
    return result;
  }
  const std::size_t stride = 1 + separating.size() / (kSamples + 1);
  for (std::size_t i = 0; i < separating.size(); i += stride) {
    std::array<Vector3d, 3> t;
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = contact_mesh.vertices[static_cast<std::size_t>(
          contact_mesh.triangles[static_cast<std::size_t>(separating[i])][k])];
    }
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).stableNormalized();
    const Vector3d middle = (t[0] + t[1] + t[2]) / 3.0;
    const Vector3d behind = middle - impl_->rounding * normal;
    if (!impl_->IsFree(behind, behind, &result.tests) ||
        impl_->IsNearlyBlocked(middle, &result.tests)) {
      continue;
    }
    result.verdict = Verdict::kRefuted;
    result.reason = "the robot is free at " + Text(middle) +
                    ", on the surface that should separate start and goal";
    break;
  }
  result.seconds = stopwatch.Seconds();
  return result;
}

Verification Verifier::VerifyDepth(const Vector3d& q,
                                   const PenetrationResult& result) const {
  const Stopwatch stopwatch;
  Verification answer;
  const auto end = [&](Verdict verdict, const std::string& reason) {
    answer.verdict = verdict;
    answer.reason = reason;
    answer.seconds = stopwatch.Seconds();
    return answer;
  };
  if (result.status == QueryStatus::kInvalid || !IsFinite(q)) {
    return end(Verdict::kRefuted, "there is no depth to verify");
  }
  const Impl& impl = *impl_;
  const auto touches = [&](const Vector3d& x) {
    return impl.Touches(x, x, &answer.tests);
  };
  const double delta = impl.Tolerance();
  const Vector3d& contact = result.contact;
  const double length = (contact - q).norm();
  if (!(std::abs(length - std::abs(result.signed_distance)) <= delta)) {
    return end(Verdict::kRefuted, "the depth is not the distance to q_c");
  }
  // Near the surface q may be on either side of the original one.
  const bool is_at_surface = length <= impl.rounding;
  if (touches(q) != result.inside && !is_at_surface) {
    return end(Verdict::kRefuted, "at " + Text(q) + " the robot " +
                                      (result.inside ? "is free" : "collides"));
  }
  // Outside the way to q_c is free.
  if (!result.inside && length > delta &&
      impl.Touches(q, contact + delta * result.direction, &answer.tests)) {
    return end(Verdict::kRefuted,
               "between " + Text(q) + " and q_c the robot collides");
  }
  const Verdict side = impl.Beside(contact, result.direction, delta,
                                   result.inside, &answer.tests);
  return end(side, side == Verdict::kConfirmed
                       ? ""
                       : "q_c, at " + Text(contact) +
                             ", is not where n leaves the contact surface");
}

Verification Verifier::VerifySurface(const Vector3d& x,
                                     const Vector3d& n) const {
  const Stopwatch stopwatch;
  Verification answer;
  for (const bool wants_free : {true, false}) {
    const Verdict side =
        impl_->Beside(x, n, impl_->Tolerance(), wants_free, &answer.tests);
    answer.verdict = std::max(answer.verdict, side);
  }
  if (answer.verdict != Verdict::kConfirmed) {
    answer.reason = Text(x) + " is not where n leaves the contact surface";
  }
  answer.seconds = stopwatch.Seconds();
  return answer;
}

}  // namespace phongpd
