// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/trade_measure.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>

#include "planners/exact/contact_surface_planner.h"
#include "problems/output/text.h"
#include "problems/scenes/kept_world.h"
#include "problems/scenes/scene_requests.h"
#include "problems/scenes/scene_source.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

struct OptimizeChoice {
  std::string name;
  std::function<void(OptimizeRequest*)> apply;
};

std::vector<OptimizeChoice> OptimizeChoices() {
  using Request = OptimizeRequest;
  const auto preset = [](Preset which) {
    return OptimizeChoice{ToString(which),
                          [which](Request* r) { ApplyPreset(which, r); }};
  };
  return {preset(Preset::kBalanced),
          preset(Preset::kFast),
          preset(Preset::kTight),
          {"--polish never",
           [](Request* r) { r->options.polish = PolishWhen::kNever; }},
          {"--polish always",
           [](Request* r) { r->options.polish = PolishWhen::kAlways; }},
          {"--rows 3", [](Request* r) { r->options.optimizer.rows = 3; }},
          {"--routes 3", [](Request* r) { r->options.routes = 3; }},
          // Interior samples of a segment; by the rule they are enough.
          {"samples 1", [](Request* r) { r->samples_per_segment = 1; }},
          {"samples 8", [](Request* r) { r->samples_per_segment = 8; }},
          {"waypoints 20", [](Request* r) { r->waypoints = 20; }}};
}

struct PlanChoice {
  std::string name;
  std::function<void(ContactSurfaceOptions*)> apply;
};

std::vector<PlanChoice> PlanChoices() {
  using Options = ContactSurfaceOptions;
  const auto preset = [](Preset which) {
    return PlanChoice{ToString(which),
                      [which](Options* o) { ApplyPreset(which, o); }};
  };
  return {preset(Preset::kBalanced),
          preset(Preset::kFast),
          preset(Preset::kTight),
          {"routes 1", [](Options* o) { o->routes = 1; }},
          {"routes 8", [](Options* o) { o->routes = 8; }},
          {"spacing 0.025", [](Options* o) { o->spacing = 0.025; }},
          {"spacing 0.1", [](Options* o) { o->spacing = 0.1; }},
          {"spacing 0.2", [](Options* o) { o->spacing = 0.2; }},
          {"gap links 0", [](Options* o) { o->gap_links = 0; }},
          {"gap links 1024", [](Options* o) { o->gap_links = 1024; }},
          {"cuts 0", [](Options* o) { o->random_cuts = 0; }},
          {"cuts 1000", [](Options* o) { o->random_cuts = 1000; }},
          {"routes 8, spacing 0.1", [](Options* o) {
             o->routes = 8;
             o->spacing = 0.1;
           }}};
}

const std::vector<std::string>& TrajectoryScenes() {
  static const std::vector<std::string> scenes = {"u_axis",
                                                  "u_trap",
                                                  "plate:thickness=0.02",
                                                  "torus_hole",
                                                  "cone_axes",
                                                  "clutter",
                                                  "knot",
                                                  "peg_tunnel:clearance=0.01"};
  return scenes;
}

const std::vector<std::string>& PassageScenes() {
  static const std::vector<std::string> scenes = {
      "hole:delta=0.001",
      "tunnel:delta=0.001,bends=3",
      "keyhole:delta=0.001",
      "comb:delta=0.001",
      "snake:delta=0.001",
      "bugtrap:delta=0.001",
      "clutter_hole:delta=0.001",
      "maze:delta=0.001,n=4",
      "hole:delta=0.001,rotation_seed=1",
      "maze:delta=0.001,n=3,rotation_seed=1",
      "clutter",
      "knot",
      "u_trap",
      "cone_axes"};
  return scenes;
}

}  // namespace

std::vector<TradeTrial> MeasureOptimize(const TradeOptions& options) {
  std::vector<TradeTrial> trials;
  for (const std::string& text : TrajectoryScenes()) {
    const SceneSource source(text);
    KeptWorld worlds;
    // What is built on first use is no part of any choice.
    const Scene first = source.Load(options.seed);
    Optimize(worlds.Of(first), OptimizeRequestOf(first));
    for (int i = 0; i < options.seeds; ++i) {
      const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
      const Scene scene = source.Load(seed);
      for (const OptimizeChoice& choice : OptimizeChoices()) {
        OptimizeRequest request = OptimizeRequestOf(scene);
        request.options.seed = seed;
        request.verifies = false;
        choice.apply(&request);
        TradeTrial trial{"optimize",  text + " #" + std::to_string(seed),
                         choice.name, 0.0,
                         false,       0.0};
        const double begin = CpuSeconds();
        const PathAnswer answer = Optimize(worlds.Of(scene), request);
        trial.seconds = CpuSeconds() - begin;
        trial.answered = answer.is_free;
        trial.measure = answer.pipeline->objective;
        trials.push_back(std::move(trial));
      }
    }
  }
  return trials;
}

std::vector<TradeTrial> MeasurePlan() {
  std::vector<TradeTrial> trials;
  for (const std::string& text : PassageScenes()) {
    const Scene scene = SceneSource(text).Load();
    const World world(scene.workspace, scene.name);
    world.Sealed().bvh();
    for (const PlanChoice& choice : PlanChoices()) {
      ContactSurfaceOptions options;
      choice.apply(&options);
      TradeTrial trial{"plan", text, choice.name, 0.0, false, 0.0};
      constexpr int kPlans = 5;
      const double begin = CpuSeconds();
      for (int repeat = 0; repeat < kPlans; ++repeat) {
        const ContactSurfacePlanner planner(world.Sealed(), options);
        const PlanResult result = planner.Plan(scene.start, scene.goal);
        trial.answered = result.status == PathStatus::kSolved;
        trial.measure = result.length;
      }
      trial.seconds = (CpuSeconds() - begin) / kPlans;
      trials.push_back(std::move(trial));
    }
  }
  return trials;
}

std::vector<TradeSum> Sum(const std::vector<TradeTrial>& trials) {
  struct Base {
    double seconds = -1.0;
    double least = std::numeric_limits<double>::infinity();
  };
  std::map<std::string, Base> bases;
  for (const TradeTrial& trial : trials) {
    Base& base = bases[trial.consumer + '\n' + trial.instance];
    if (base.seconds < 0.0) base.seconds = trial.seconds;
    if (trial.answered) base.least = std::min(base.least, trial.measure);
  }
  struct Values {
    std::vector<double> times, excess;
  };
  std::vector<TradeSum> sums;
  std::vector<Values> values;
  for (const TradeTrial& trial : trials) {
    const auto same =
        std::find_if(sums.begin(), sums.end(), [&](const TradeSum& s) {
          return s.consumer == trial.consumer && s.choice == trial.choice;
        });
    const auto at = static_cast<std::size_t>(same - sums.begin());
    if (same == sums.end()) {
      sums.emplace_back();
      sums.back().consumer = trial.consumer;
      sums.back().choice = trial.choice;
      values.emplace_back();
    }
    const Base& base = bases[trial.consumer + '\n' + trial.instance];
    ++sums[at].instances;
    values[at].times.push_back(trial.seconds / base.seconds);
    if (!trial.answered) continue;
    ++sums[at].answered;
    values[at].excess.push_back(100.0 * (trial.measure / base.least - 1.0));
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i].time = Quantile(values[i].times, 0.5);
    sums[i].slow = Quantile(values[i].times, 0.9);
    sums[i].worst = Quantile(values[i].excess, 1.0);
    for (const double e : values[i].excess) {
      sums[i].excess += e / static_cast<double>(values[i].excess.size());
    }
  }
  return sums;
}

}  // namespace phongpd::bench
