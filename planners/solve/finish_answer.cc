// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/finish_answer.h"

#include <algorithm>

#include "core/minkowski/build_stop.h"
#include "core/number_text.h"
#include "core/stopwatch.h"
#include "planners/world/room.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Of what is asked: solvers keep their constraints to within so much.
constexpr double kTolerance = 1e-6;

std::string Told(const World& world, double length) {
  const std::string& unit = world.workspace().unit;
  return Rounded(length, 4) + (unit.empty() ? "unit" : unit);
}

std::optional<Verification> Verify(const World& world, const Vector3d& start,
                                   const Vector3d& goal,
                                   const PathAnswer& answer) {
  const bool at_start = IsStartBlocked(answer.status);
  const bool is_blocked = at_start || IsGoalBlocked(answer.status);
  const bool has_motion = answer.is_free && !answer.motion.empty();
  const bool has_path = has_motion || (answer.is_free && !answer.path.empty());
  if (!has_path && !is_blocked && !answer.IsInfeasible()) return std::nullopt;
  const Verifier verifier(world.workspace());
  if (is_blocked) return verifier.VerifyBlocked(at_start ? start : goal);
  if (!has_path) {
    const TriangleMesh& surface = answer.evidence.surface
                                      ? answer.evidence.surface->mesh()
                                      : world.Sealed().mesh();
    return verifier.VerifySeparation(surface, start, goal);
  }
  const Vector3d& first =
      has_motion ? answer.motion.pieces().front().front() : answer.path.front();
  const Vector3d& last =
      has_motion ? answer.motion.pieces().back().back() : answer.path.back();
  if (first != start || last != goal) {
    Verification elsewhere;
    elsewhere.verdict = Verdict::kRefuted;
    elsewhere.reason = "the path does not lead from start to goal";
    return elsewhere;
  }
  return has_motion ? verifier.VerifyCurve(answer.motion)
                    : verifier.VerifyPath(answer.path);
}

void TellClearance(const World& world, const Vector3d& start,
                   const Vector3d& goal, const ClearanceWish& wish,
                   PathAnswer* answer) {
  if (!wish.asked) return;
  answer->wish.asked = world.Resolve(*wish.asked);
  if (!answer->is_free) return;
  const double asked = answer->wish.asked->unit;
  const double shortfall = asked - answer->clearance;
  const bool is_kept = shortfall <= kTolerance * asked;
  answer->wish.shortfall = is_kept ? 0.0 : shortfall;
  if (is_kept || !(wish.is_own || wish.is_required)) return;
  if (!answer->reason.empty()) answer->reason += "; ";
  answer->reason += "the path keeps " + Told(world, answer->clearance) +
                    " of the " + wish.name + " of " + Told(world, asked) +
                    "; the start has " +
                    Told(world, Room(world.workspace(), start)) +
                    ", the goal " + Told(world, Room(world.workspace(), goal));
  if (!wish.is_required) return;
  answer->status = PathStatus::kClearanceMissed;
  answer->is_solved = false;
}

}  // namespace

bool AreEndsFree(const World& world, const Vector3d& start,
                 const Vector3d& goal, PathAnswer* answer) {
  for (const bool at_start : {true, false}) {
    const Diagnosis diagnosis = world.Diagnose(at_start ? start : goal);
    if (diagnosis.IsFree()) continue;
    answer->reason = diagnosis.Text(at_start ? "start" : "goal");
    answer->status = diagnosis.IsOnlyOutOfBounds()
                         ? at_start ? PathStatus::kStartOutOfBounds
                                    : PathStatus::kGoalOutOfBounds
                     : at_start ? PathStatus::kStartInCollision
                                : PathStatus::kGoalInCollision;
    return false;
  }
  return true;
}

bool UsesWindow(const World& world, Model model,
                const std::vector<SpaceLayout>& layouts, std::string* refusal) {
  if (model != Model::kAuto) {
    if (model == Model::kFull) {
      for (const SpaceLayout layout : layouts) world.Spaces(layout);
    }
    return model == Model::kWindow;
  }
  // Once for a world: what was refused is not tried again.
  std::string tag;
  for (const SpaceLayout layout : layouts) {
    tag += std::to_string(static_cast<int>(layout)) + ' ';
  }
  *refusal = *world.Kept<std::string>("refusal " + tag, [&] {
    try {
      for (const SpaceLayout layout : layouts) world.Spaces(layout);
    } catch (const BuildRefusal& error) {
      return std::string(error.what());
    }
    return std::string();
  });
  return !refusal->empty();
}

std::string BeyondTheEnds(const World& world, const Vector3d& start,
                          const Vector3d& goal, const ClearanceWish& wish) {
  if (!wish.asked || !(wish.is_own || wish.is_required)) return "";
  const double asked = world.Resolve(*wish.asked).unit;
  const double at_start = Room(world.workspace(), start);
  const double at_goal = Room(world.workspace(), goal);
  // Ends that are not free are told of by themselves.
  if (!(at_start > 0.0 && at_goal > 0.0)) return "";
  if (std::min(at_start, at_goal) >= (1.0 - kTolerance) * asked) return "";
  return "no path keeps the " + wish.name + " of " + Told(world, asked) +
         ": the start has " + Told(world, at_start) + ", the goal " +
         Told(world, at_goal);
}

void Finish(const World& world, const Vector3d& start, const Vector3d& goal,
            const ClearanceWish& wish, bool verifies, PathAnswer* answer) {
  PathEvidence& evidence = answer->evidence;
  const Stopwatch stopwatch;
  if (verifies) {
    evidence.verification = Verify(world, start, goal, *answer);
    evidence.verification_seconds = stopwatch.Seconds();
  }
  if (evidence.verification &&
      evidence.verification->verdict == Verdict::kRefuted) {
    answer->status = PathStatus::kVerificationFailed;
    answer->reason = evidence.verification->reason;
    answer->is_free = answer->is_solved = false;
  }
  TellClearance(world, start, goal, wish, answer);
}

}  // namespace phongpd::internal
