// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>

#include "core/contact/contact_space_cache.h"
#include "problems/scenes/fleet_scene.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/turning_scene.h"

namespace phongpd::cli {

// A scene that can be asked about: of one robot, of one that turns, of several.
using ServedScene = std::variant<Scene, TurningScene, FleetScene>;

// Answers what the page of a scene asks (solve_question.h), in worlds that keep
// what they have built from question to question.  Everything that a question
// does not say is as the scene says, with at most `seconds` for each search and
// build.
//
// The answer, whatever the scene is of:
//   what       as asked
//   row        what `phongpd plan` or `optimize` writes of it, by the same
//              writer
//   paths      of the page (view_entries.h): one, without points if there is
//              none; of several robots one for each
//   movers     where obstacles that move are meanwhile, of motions in time
//   collision  where an end meets an obstacle, and the row does not tell which
//              triangles: "triangle 3 of the robot meets ..."
//   closest    of several robots: who comes closest to whom
// or, of "depth", a row of `phongpd depth` for each obstacle (ObstacleDepths):
//   rows, answers
class SceneSolver {
 public:
  virtual ~SceneSolver() = default;

  // One at a time.  Throws InputError "question: /start: expected ..., found
  // ..." and what Plan, Optimize and DepthQuery throw.  Ends soon after
  // `is_cancelled` says so, if CancelBuilds is called as well, with whatever
  // there is or BuildCancelled.
  virtual nlohmann::ordered_json Answer(
      const std::string& question,
      const std::function<bool()>& is_cancelled) = 0;
};

// Throws what World and RigidWorld throw.
std::unique_ptr<SceneSolver> SolverOf(const ServedScene& scene,
                                      const ContactSpaceCache& cache,
                                      double seconds);

// Of each kind.
std::unique_ptr<SceneSolver> TranslatingSolver(const Scene& scene,
                                               const ContactSpaceCache& cache,
                                               double seconds);
std::unique_ptr<SceneSolver> TurningSolver(const TurningScene& scene,
                                           double seconds);
std::unique_ptr<SceneSolver> FleetSolver(const FleetScene& scene,
                                         const ContactSpaceCache& cache,
                                         double seconds);

}  // namespace phongpd::cli
