// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/budget_measure.h"

#include <map>
#include <random>
#include <utility>

#include "core/minkowski/build_stop.h"
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "planners/world/budget.h"
#include "results/bench/free_space_measure.h"
#include "results/bench/random_ends.h"

namespace phongpd::bench {
namespace {

std::vector<BudgetFlags> PlanFlags() {
  std::vector<BudgetFlags> all;
  for (const Model model : {Model::kWindow, Model::kFull}) {
    for (const Preset preset :
         {Preset::kFast, Preset::kBalanced, Preset::kTight}) {
      all.push_back({model, preset});
    }
  }
  all.push_back({Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect});
  all.push_back(
      {Model::kFull, Preset::kBalanced, PlannerId::kRetractionForest});
  return all;
}

std::vector<BudgetFlags> OptimizeFlags() {
  std::vector<BudgetFlags> all;
  const auto add = [&all](Preset preset, MetricKind metric) {
    for (const Model model : {Model::kWindow, Model::kFull}) {
      all.push_back({model, preset, BudgetFlags().planner, metric});
    }
  };
  for (const Preset preset :
       {Preset::kFast, Preset::kBalanced, Preset::kTight}) {
    add(preset, MetricKind::kPhong);
  }
  for (const Preset preset : {Preset::kFast, Preset::kBalanced}) {
    add(preset, MetricKind::kEuclidean);
  }
  return all;
}

// All flags on one pair of solids.
class CaseRun {
 public:
  CaseRun(const BudgetCase& pair, const BudgetOptions& options)
      : pair_(pair), cache_{options.cache}, random_(options.seed) {
    workspace_.robot = MakeSolid(pair.robot(), "robot");
    workspace_.obstacles = {MakeSolid(pair.obstacle(), "obstacle")};
  }

  void Take(std::uint64_t seed) {
    const World world(workspace_);
    const Ends ends = RandomEnds(world, &random_);
    for (const BudgetFlags& flags : PlanFlags()) {
      PlanRequest request;
      request.start = ends.start;
      request.goal = ends.goal;
      request.planner = flags.planner;
      request.model = flags.model;
      request.preset = flags.preset;
      request.time_limit = kMostSeconds;
      request.seed = seed;
      request.verifies = false;
      const bool is_full = flags.model == Model::kFull;
      Answer(
          "plan", ToString(flags), is_full, seed,
          [&](const World& w) { BuildForPlan(w, flags); },
          [&](const World& w) { return Plan(w, request); });
    }
    for (const BudgetFlags& flags : OptimizeFlags()) {
      OptimizeRequest request;
      ApplyPreset(flags.preset, &request);
      request.start = ends.start;
      request.goal = ends.goal;
      request.model = flags.model;
      request.penetration.metric = flags.metric;
      request.search_time = kMostSeconds;
      request.options.time_limit = 2.0 * kMostSeconds;
      request.options.seed = seed;
      request.verifies = false;
      const bool is_full = flags.model == Model::kFull;
      Answer(
          "optimize", ToString(flags), is_full, seed,
          [&](const World& w) {
            is_full ? static_cast<void>(w.Spaces(SpaceLayout::kMerged))
                    : static_cast<void>(w.Convolution());
          },
          [&](const World& w) { return Optimize(w, request); });
    }
  }

  std::vector<BudgetRow> rows;

 private:
  static void BuildForPlan(const World& world, const BudgetFlags& flags) {
    if (flags.model == Model::kFull) {
      world.Sealed();
    } else if (flags.planner == PlannerId::kContactSurface) {
      world.SealedConvolution();
    } else {
      world.Convolution();
    }
  }

  // In a world of its own.
  template <typename Build, typename Solve>
  void Answer(const std::string& use, const std::string& flags, bool is_full,
              std::uint64_t seed, const Build& build, const Solve& solve) {
    const std::string key = use + ' ' + (is_full ? "full" : flags);
    BudgetRow row;
    row.use = use;
    row.family = pair_.family;
    row.flags = flags;
    row.decade = pair_.decade;
    row.triangles = workspace_.robot.mesh().triangles.size() +
                    workspace_.obstacles[0].mesh().triangles.size();
    row.seed = seed;
    const auto known = without_.find(key);
    if (known != without_.end()) {
      row.status = known->second;
      rows.push_back(std::move(row));
      return;
    }
    // Of the wall, on a machine that may have other work.
    WorldLimits limits;
    limits.max_seconds = 6.0 * kMostSeconds;
    const World world(workspace_, "world", cache_, limits);
    double begin = CpuSeconds();
    try {
      build(world);
      row.build = CpuSeconds() - begin;
      begin += row.build;
      if (is_full) TakeBuild(world.Report(), &row.build);
      if (row.build > kMostSeconds) {
        row.status = without_[key] = "over";
      } else {
        Judge(world, solve(world), &row);
        row.answer = CpuSeconds() - begin;
      }
    } catch (const BuildRefusal&) {
      row.status = without_[key] = "refused";
    }
    rows.push_back(std::move(row));
  }

  // A whole contact space is built once for each pair, and then read: what
  // that build took counts every time.
  void TakeBuild(const WorldReport& report, double* seconds) {
    if (report.from_cache) {
      *seconds = build_;
    } else {
      build_ = *seconds;
    }
  }

  static void Judge(const World& world, const PathAnswer& answer,
                    BudgetRow* row) {
    row->status = ToString(answer.status);
    row->is_free = answer.is_free && !answer.path.empty();
    if (!row->is_free) return;
    row->length = answer.length / world.diagonal();
    row->clearance = answer.clearance / world.diagonal();
  }

  const BudgetCase& pair_;
  const ContactSpaceCache cache_;
  double build_ = 0.0;
  std::mt19937_64 random_;
  Workspace workspace_;
  // Models that are not to be had here, and why.
  std::map<std::string, std::string> without_;
};

}  // namespace

std::vector<BudgetRow> MeasureBudget(const BudgetCase& pair,
                                     const BudgetOptions& options) {
  CaseRun run(pair, options);
  for (int i = 0; i < options.seeds; ++i) {
    run.Take(options.seed + static_cast<std::uint64_t>(i));
  }
  return std::move(run.rows);
}

NamedTable BudgetTable(const std::vector<BudgetRow>& rows) {
  return {"budget.csv",
          MakeTable({"use", "family", "decade", "triangles", "seed", "flags",
                     "build, CPU s", "answer, CPU s", "status", "free",
                     "length / D", "clearance / D"},
                    rows, [](const BudgetRow& r, const auto& add) {
                      add(r.use, r.family, r.decade, r.triangles,
                          std::to_string(r.seed), r.flags, Rounded(r.build, 4),
                          Rounded(r.answer, 4), r.status,
                          std::string(r.is_free ? "yes" : "no"),
                          Rounded(r.length, 7), Rounded(r.clearance, 7));
                    })};
}

}  // namespace phongpd::bench
