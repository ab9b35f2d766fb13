// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace phongpd::bench {

struct PlanningOptions {
  int seeds = 50;
  double limit = 1.0;  // seconds of a run
  int hopeless = 5;    // runs without a solution after which a planner stops
  std::uint64_t seed = 1;
};

// A problem as SceneSource spells it, and what it belongs to.
struct PlanningProblem {
  std::string family;
  std::string scene;
  double delta = 0.0;  // side of the free channel
  bool is_turned = false;
  bool is_feasible = true;
};

// The contact-surface planner on one problem.
struct ExactRow {
  PlanningProblem problem;
  std::string status;
  bool is_right = false;      // solved if feasible, proved infeasible if not
  double milliseconds = 0.0;  // median of a query
  double build_milliseconds = 0.0;
  double contact_space_milliseconds = 0.0;
  std::size_t triangles = 0;
  double length = 0.0;
  double clearance = 0.0;
  double witness_length = 0.0;  // of the scene's own way through, as short as
                                // exact tests allow; 0: there is none
};

// One run of a sampling planner.
struct SamplerRun {
  bool is_solved = false;  // exactly free
  bool is_false = false;   // claimed, but not free
  double seconds = 0.0;
  double samples = 0.0;
  double samples_to_passage = -1.0;  // −1: never, or not counted
  double collision_checks = 0.0, segment_checks = 0.0, retractions = 0.0;
  double length = 0.0;
  double clearance = 0.0;
};

struct SamplerRow {
  PlanningProblem problem;
  std::string planner;  // "retraction-forest phong", "rrt-connect", ...
  std::vector<SamplerRun> runs;
};

// A motion check against a large contact space.
struct MotionRow {
  std::string scene;
  std::size_t triangles = 0;
  double median_microseconds = 0.0, slow_microseconds = 0.0;  // 95 %
  double blocked_share = 0.0;
};

// Every family with the knob at all its values, aligned and turned, and the
// infeasible twins.
std::vector<PlanningProblem> ExactProblems();
// One δ for each family, aligned and turned; δ from wide to narrow for a few.
std::vector<PlanningProblem> SamplerProblems();
std::vector<PlanningProblem> NarrowingProblems();

ExactRow MeasureExact(const PlanningProblem& problem);

// `planners`: "NAME" or "NAME RETRACTION".
std::vector<SamplerRow> MeasureSamplers(
    const PlanningProblem& problem, const std::vector<std::string>& planners,
    const PlanningOptions& options);

MotionRow MeasureMotions(const std::string& scene, std::uint64_t seed);

}  // namespace phongpd::bench
