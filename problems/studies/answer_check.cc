// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/answer_check.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "core/stopwatch.h"

namespace phongpd {
namespace {

std::optional<Verification> Verify(const Scene& scene, const World& world,
                                   const AnswerClaims& claims) {
  const bool is_blocked = claims.start_is_blocked || claims.goal_is_blocked;
  const bool has_curve = !claims.curve.empty();
  const bool has_path = has_curve || !claims.path.empty();
  if (!has_path && !claims.proves_separation && !is_blocked) {
    return std::nullopt;
  }
  const Verifier verifier(scene.workspace);
  if (is_blocked) {
    return verifier.VerifyBlocked(claims.start_is_blocked ? scene.start
                                                          : scene.goal);
  }
  if (!has_path) {
    const ContactSpace& surface =
        claims.surface ? *claims.surface : world.Sealed();
    return verifier.VerifySeparation(surface.mesh(), scene.start, scene.goal);
  }
  const Eigen::Vector3d& first =
      has_curve ? claims.curve.pieces().front().front() : claims.path.front();
  const Eigen::Vector3d& last =
      has_curve ? claims.curve.pieces().back().back() : claims.path.back();
  if (first != scene.start || last != scene.goal) {
    Verification elsewhere;
    elsewhere.verdict = Verdict::kRefuted;
    elsewhere.reason = "the path does not lead from start to goal";
    return elsewhere;
  }
  return has_curve ? verifier.VerifyCurve(claims.curve)
                   : verifier.VerifyPath(claims.path);
}

// Of a planner's own status.
void SayBlockedEnds(const std::string& status, AnswerClaims* claims) {
  claims->start_is_blocked = status == ToString(PlanStatus::kInvalidStart) ||
                             status == ToString(PlanStatus::kStartOutOfBounds);
  claims->goal_is_blocked = status == ToString(PlanStatus::kInvalidGoal) ||
                            status == ToString(PlanStatus::kGoalOutOfBounds);
}

}  // namespace

AnswerClaims ClaimsOf(const PipelineResult& result) {
  AnswerClaims claims;
  if (result.certificate.free) claims.path = result.path;
  claims.proves_separation =
      result.status == TrajectoryStatus::kInfeasibleProved;
  claims.start_is_blocked =
      result.status == TrajectoryStatus::kStartInCollision ||
      result.status == TrajectoryStatus::kStartOutOfBounds;
  claims.goal_is_blocked =
      result.status == TrajectoryStatus::kGoalInCollision ||
      result.status == TrajectoryStatus::kGoalOutOfBounds;
  return claims;
}

AnswerClaims ClaimsOf(const PlanningResult& result) {
  AnswerClaims claims;
  if (result.solved) claims.path = result.numbers.path;
  claims.proves_separation = result.infeasible_proved;
  if (result.explored) claims.surface = result.explored->surface;
  SayBlockedEnds(result.status, &claims);
  return claims;
}

AnswerClaims ClaimsOf(const TimedTrajectory& timed) {
  AnswerClaims claims;
  if (timed.is_certified) claims.curve = timed.curve.trajectory;
  claims.proves_separation =
      timed.status == ToString(PlanStatus::kInfeasibleProved);
  claims.surface = timed.surface;
  SayBlockedEnds(timed.status, &claims);
  return claims;
}

bool AnswerCheck::Judge(const Scene& scene, const World& world,
                        const AnswerClaims& claims,
                        nlohmann::ordered_json* row) {
  const Stopwatch stopwatch;
  const std::optional<Verification> found =
      is_on_ ? Verify(scene, world, claims) : std::nullopt;
  (*row)["verified"] = nullptr;
  (*row)["seconds"]["verification"] = stopwatch.Seconds();
  if (!found) return true;
  (*row)["verified"] = ToString(found->verdict);
  if (found->verdict != Verdict::kRefuted) return true;
  for (const char* key : {"status", "status_class"}) {
    if (row->contains(key)) (*row)[key] = "verification_failed";
  }
  for (const char* key : {"solved", "infeasible_proved", "collision_free",
                          "solver_path_free", "certified"}) {
    if (row->contains(key)) (*row)[key] = false;
  }
  (*row)["reason"] = found->reason;
  if (failure_.empty()) failure_ = scene.name + ": " + found->reason;
  return false;
}

void AnswerCheck::RequireNoFailure() const {
  if (!failure_.empty()) FailVerification(failure_);
}

void FailVerification(const std::string& what) {
  throw std::runtime_error("verification on the original solids failed: " +
                           what);
}

}  // namespace phongpd
