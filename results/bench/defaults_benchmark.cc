// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: are the defaults right?  The planner's spacing, the optimiser's rows
// a sample and its second start against their challengers, instance by instance
// in one process: processor time, and the length or energy of what is found.
// Writes defaults.csv, of which defaults_report.py makes tests and defaults.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

#include "planners/exact/contact_surface_planner.h"
#include "problems/scenes/kept_world.h"
#include "problems/scenes/scene_requests.h"
#include "problems/scenes/scene_source.h"
#include "results/bench/planning_measure.h"
#include "results/bench/program.h"
#include "results/bench/trade_measure.h"

namespace phongpd::bench {
namespace {

// Of a length or an energy: less is the same.
constexpr double kSame = 1e-3;

// What a choice gave on one instance.
struct Outcome {
  bool is_answered = false;   // exactly free
  bool is_converged = false;  // of the optimiser; else is_answered
  double seconds = 0.0;
  double measure = 0.0;
};

// One choice against the default over all instances.
struct Contest {
  std::string consumer, incumbent, challenger;
  int instances = 0;
  int answered[2] = {0, 0}, converged[2] = {0, 0};
  int faster = 0, slower = 0, shorter = 0, longer = 0;
  std::vector<double> times, measures;  // challenger over incumbent

  void Add(const Outcome& old, const Outcome& next) {
    ++instances;
    answered[0] += old.is_answered;
    answered[1] += next.is_answered;
    converged[0] += old.is_converged;
    converged[1] += next.is_converged;
    times.push_back(next.seconds / old.seconds);
    faster += next.seconds < old.seconds;
    slower += next.seconds > old.seconds;
    if (!old.is_answered || !next.is_answered) return;
    const double ratio = old.measure > 0.0 ? next.measure / old.measure : 1.0;
    measures.push_back(ratio);
    shorter += ratio < 1.0 - kSame;
    longer += ratio > 1.0 + kSame;
  }
};

using Solve = std::function<Outcome()>;

// Twice each, in turn, and the quicker of both times: what comes first warms
// caches for the other.
void Race(const Solve& incumbent, const Solve& challenger, Contest* contest) {
  Outcome best[2];
  for (int turn = 0; turn < 2; ++turn) {
    for (const int which : {0, 1}) {
      const double begin = CpuSeconds();
      Outcome outcome = which == 0 ? incumbent() : challenger();
      outcome.seconds = CpuSeconds() - begin;
      if (turn > 0) {
        outcome.seconds = std::min(outcome.seconds, best[which].seconds);
      }
      best[which] = outcome;
    }
  }
  contest->Add(best[0], best[1]);
}

Outcome PlanOnce(const World& world, const Scene& scene, double spacing) {
  ContactSurfaceOptions options;
  options.spacing = spacing;
  const PlanResult found = ContactSurfacePlanner(world.Sealed(), options)
                               .Plan(scene.start, scene.goal);
  const bool is_solved = found.status == PathStatus::kSolved;
  return {is_solved, is_solved, 0.0, found.length};
}

// The feasible problems of the planning study, and the scenes given.
std::vector<Scene> PlanScenes(const std::vector<std::string>& scenes,
                              std::uint64_t seed, int seeds) {
  std::vector<Scene> all;
  for (const PlanningProblem& problem : ExactProblems()) {
    if (problem.is_feasible) all.push_back(SceneSource(problem.scene).Load());
  }
  for (const std::string& text : scenes) {
    for (int i = 0; i < seeds; ++i) {
      all.push_back(
          SceneSource(text).Load(seed + static_cast<std::uint64_t>(i)));
    }
  }
  return all;
}

std::vector<Contest> ContestSpacing(const std::vector<Scene>& scenes,
                                    double incumbent,
                                    const std::vector<double>& challengers) {
  std::vector<Contest> contests;
  for (const double spacing : challengers) {
    contests.emplace_back();
    contests.back().consumer = "plan, contact-surface";
    contests.back().incumbent = "spacing " + Rounded(incumbent);
    contests.back().challenger = "spacing " + Rounded(spacing);
  }
  for (const Scene& scene : scenes) {
    const World world(scene.workspace, scene.name);
    world.Sealed().bvh();
    for (std::size_t k = 0; k < challengers.size(); ++k) {
      Race([&] { return PlanOnce(world, scene, incumbent); },
           [&] { return PlanOnce(world, scene, challengers[k]); },
           &contests[k]);
    }
    std::cerr << scene.name << std::endl;
  }
  return contests;
}

using Change = std::function<void(PipelineOptions*)>;

Outcome OptimizeOnce(const Scene& scene, const World& world, std::uint64_t seed,
                     const Change& change) {
  OptimizeRequest request = OptimizeRequestOf(scene);
  request.options.seed = seed;
  request.verifies = false;
  change(&request.options);
  const PathAnswer found = Optimize(world, request);
  return {found.is_free,
          found.status == PathStatus::kSolved ||
              found.status == PathStatus::kPolished,
          0.0, found.pipeline->objective};
}

Contest ContestOptimize(const std::string& incumbent,
                        const std::string& challenger, const Change& change,
                        const std::vector<std::string>& scenes,
                        std::uint64_t seed, int seeds) {
  Contest contest;
  contest.consumer = "optimize";
  contest.incumbent = incumbent;
  contest.challenger = challenger;
  const Change none = [](PipelineOptions*) {};
  for (const std::string& text : scenes) {
    const SceneSource source(text);
    KeptWorld worlds;
    // What is built on first use is no part of either.
    const Scene first = source.Load(seed);
    OptimizeOnce(first, worlds.Of(first), seed, none);
    for (int i = 0; i < seeds; ++i) {
      const std::uint64_t own = seed + static_cast<std::uint64_t>(i);
      const Scene scene = source.Load(own);
      const World& world = worlds.Of(scene);
      Race([&] { return OptimizeOnce(scene, world, own, none); },
           [&] { return OptimizeOnce(scene, world, own, change); }, &contest);
    }
    std::cerr << challenger << ", " << text << std::endl;
  }
  return contest;
}

double Mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / std::max<double>(1.0, static_cast<double>(values.size()));
}

Table ContestTable(const std::vector<Contest>& contests) {
  const auto pair = [](const int(&n)[2]) {
    return Shown(n[0]) + " : " + Shown(n[1]);
  };
  return MakeTable(
      {"consumer", "default", "challenger", "instances", "exactly free",
       "converged", "time", "time, quartiles", "faster : slower",
       "length or energy", "its quartiles", "shorter : longer"},
      contests, [&](const Contest& c, const auto& add) {
        const auto quartiles = [](const std::vector<double>& v, int digits) {
          return Rounded(Quantile(v, 0.25), digits) + " – " +
                 Rounded(Quantile(v, 0.75), digits);
        };
        add(c.consumer, c.incumbent, c.challenger, c.instances,
            pair(c.answered), pair(c.converged), Quantile(c.times, 0.5),
            quartiles(c.times, 3), Shown(c.faster) + " : " + Shown(c.slower),
            Rounded(Mean(c.measures), 5), quartiles(c.measures, 5),
            Shown(c.shorter) + " : " + Shown(c.longer));
      });
}

}  // namespace

int Run(Program* program) {
  CLI::App& app = program->WithOutput("Defaults against their challengers.");
  std::vector<std::string> scenes;
  double incumbent = 0.05;
  std::vector<double> challengers = {0.1, 0.2};
  int seeds = 5;
  std::uint64_t seed = 101;
  app.add_option("--scenes", scenes, "Of the convergence study")->required();
  app.add_option("--spacing", incumbent, "The planner's default")
      ->capture_default_str();
  app.add_option("--challengers", challengers)->capture_default_str();
  app.add_option("--seeds", seeds, "A scene")->capture_default_str();
  app.add_option("--seed", seed)->capture_default_str();
  program->Parse();
  std::vector<Contest> contests =
      ContestSpacing(PlanScenes(scenes, seed, seeds), incumbent, challengers);
  contests.push_back(ContestOptimize(
      "rows 1", "rows 3", [](PipelineOptions* o) { o->optimizer.rows = 3; },
      scenes, seed, seeds));
  contests.push_back(ContestOptimize(
      "also_line", "the repaired start alone",
      [](PipelineOptions* o) { o->also_line = false; }, scenes, seed, seeds));
  const Table table = ContestTable(contests);
  program->Write("defaults.csv", ToCsv(table));
  program->Finish(seed, "defaults_measured.txt");
  std::cout << ToText(table);
  return 0;
}

}  // namespace phongpd::bench
