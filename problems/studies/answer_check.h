// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "constraints/trajectory.h"
#include "planners/exact/verification.h"
#include "planners/trajectory/trajectory_pipeline.h"
#include "planners/world/world.h"
#include "problems/scenes/scene.h"
#include "problems/studies/planning_study.h"
#include "problems/studies/timed_trajectory.h"

namespace phongpd {

// What an answer says of its scene; at most one of these.
struct AnswerClaims {
  std::vector<Eigen::Vector3d> path;  // free, from start to goal
  Trajectory curve;                   // the same in time, for all t
  bool proves_separation = false;     // there is none
  // What the proof rests on; none: the world's sealed space.
  std::optional<ContactSpace> surface;
  bool start_is_blocked = false;
  bool goal_is_blocked = false;
};

AnswerClaims ClaimsOf(const PipelineResult& result);
AnswerClaims ClaimsOf(const PlanningResult& result);
AnswerClaims ClaimsOf(const TimedTrajectory& timed);

// The second judgement of the answers that a command writes, on the scene's
// solids (planners/exact/verification.h).
class AnswerCheck {
 public:
  explicit AnswerCheck(bool is_on) : is_on_(is_on) {}

  // Judges the claims and says so in the answer's row: `verified` is the
  // verdict, null where there is no claim or no check; seconds.verification.
  // Returns false where a claim is refuted, and takes it back: status and
  // status_class become verification_failed, and nothing is called free.
  // `world` is the scene's; only a proof needs its sealed space.
  bool Judge(const Scene& scene, const World& world, const AnswerClaims& claims,
             nlohmann::ordered_json* row);

  // FailVerification with what was refuted first, if anything.
  void RequireNoFailure() const;

 private:
  bool is_on_;
  std::string failure_;
};

// Throws std::runtime_error: a wrong answer is a fault of the program.
[[noreturn]] void FailVerification(const std::string& what);

}  // namespace phongpd
