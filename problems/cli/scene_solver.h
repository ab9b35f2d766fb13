// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/contact/contact_space_cache.h"
#include "problems/scenes/scene.h"

namespace phongpd::cli {

// Answers what the page of a scene asks, in one world, which keeps what it has
// built from question to question.
//
// A question is an object of JSON:
//   what     "plan", "optimize" or "depth"
//   start    [x, y, z], where the robot begins, or how deep it is there; the
//            scene's unit
//   goal     the same of its end; not of "depth"
//   options  planner and seed of "plan", metric and seed of "optimize", preset
//            of both: as the commands' flags of these names; no others
// Everything else is as the scene says, with at most `seconds` for each search
// and build.
//
// The answer:
//   what     as asked
//   row      what `phongpd plan` or `optimize` writes of it, by the same writer
//   paths    of the page (view_json.h): one, without points if there is none
// or, of "depth", a row of `phongpd depth` for each obstacle, with its name as
// "obstacle":
//   rows, answers
class SceneSolver {
 public:
  // Throws what World throws.
  SceneSolver(const Scene& scene, const ContactSpaceCache& cache,
              double seconds);
  ~SceneSolver();

  // One at a time.  Throws InputError "question: /start: expected ..., found
  // ..." and what Plan, Optimize and DepthQuery throw.
  nlohmann::ordered_json Answer(const std::string& question);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd::cli
