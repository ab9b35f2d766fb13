// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "planners/ompl/ompl_planning.h"
#include "problems/scenes/scene_requests.h"
#include "problems/scenes/scene_source.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/random_vector.h"
#include "problems/shapes/shapes.h"
#include "results/bench/paper_benchmarks.h"
#include "results/bench/report.h"
#include "results/bench/trade_measure.h"

namespace phongpd::bench {

std::vector<TradeTrial> MeasureModels(const TradeOptions& options) {
  SilenceOmpl();
  std::vector<TradeTrial> trials;
  // Channels that samplers get through: what is compared is what is built.
  for (const char* text : {"ball_wrench", "cone_axes", "clutter", "knot",
                           "torus_hole", "u_trap", "plate:thickness=0.02"}) {
    for (int i = 0; i < options.seeds; ++i) {
      const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
      const std::string instance = text + (" #" + std::to_string(seed));
      for (const Model model : {Model::kFull, Model::kWindow}) {
        Scene scene = SceneSource(text).Load(seed);
        scene.planning.model = scene.trajectory.model = model;
        double begin = CpuSeconds();
        PlanRequest plan_request = PlanRequestOf(scene);
        plan_request.planner = PlannerId::kRrtConnect;
        plan_request.time_limit = 5.0;
        plan_request.seed = seed;
        plan_request.verifies = false;
        const PathAnswer plan =
            Plan(World(scene.workspace, scene.name), plan_request);
        trials.push_back({"model: plan", instance, ToString(model),
                          CpuSeconds() - begin, plan.is_solved, plan.length});
        begin = CpuSeconds();
        OptimizeRequest request = OptimizeRequestOf(scene);
        request.verifies = false;
        const PathAnswer path =
            Optimize(World(scene.workspace, scene.name), request);
        trials.push_back({"model: optimize", instance, ToString(model),
                          CpuSeconds() - begin, path.is_free,
                          path.pipeline->objective});
      }
    }
  }
  return trials;
}

namespace {

struct Pair {
  std::string name;
  TriangleMesh robot, obstacle;
};

std::vector<Pair> Pairs() {
  std::vector<Pair> pairs;
  for (const PaperBenchmark& paper : PaperBenchmarks()) {
    pairs.push_back({paper.title, paper.robot, paper.obstacle});
  }
  pairs.push_back(
      {"ball + knot", MakeIcoBall(0.25, 2), MakeKnot(0.5, 0.2, 96, 12)});
  pairs.push_back(
      {"star + organic body", MakeStar(0.2, 0.4), MakeBlob(1.5, 4, 0.35, 1)});
  pairs.push_back({"ball + scanned U", MakeIcoBall(0.25, 2),
                   MakeScan(MakeU(2.0, 0.3, 0.6), 0.15, 0.002, 3)});
  return pairs;
}

struct Choice {
  std::string name;
  std::function<void(const Pair&, ContactSpaceOptions*)> apply;
};

std::vector<Choice> Choices() {
  const auto faces = [](double share) {
    return [share](const Pair& pair, ContactSpaceOptions* o) {
      const auto larger =
          std::max(pair.robot.triangles.size(), pair.obstacle.triangles.size());
      o->target_faces = std::max<std::size_t>(
          20, static_cast<std::size_t>(share * static_cast<double>(larger)));
    };
  };
  const auto wrap = [](double share) {
    return
        [share](const Pair&, ContactSpaceOptions* o) { o->wrap_alpha = share; };
  };
  return {{"exact", [](const Pair&, ContactSpaceOptions*) {}},
          {"--robot-hull",
           [](const Pair&, ContactSpaceOptions* o) { o->robot_hull = true; }},
          {"--target-faces 1/2", faces(0.5)},
          {"--target-faces 1/4", faces(0.25)},
          {"--target-faces 1/10", faces(0.1)},
          {"--wrap 0.05", wrap(0.05)},
          {"--wrap 0.02", wrap(0.02)}};
}

// Against exact answers at the same points.
void Judge(const EuclideanMetric& exact, const EuclideanMetric& metric,
           const std::vector<Eigen::Vector3d>& points, double diagonal,
           ApproximationRow* row) {
  double inside = 0.0, outside = 0.0, errors = 0.0;
  for (const Eigen::Vector3d& q : points) {
    const PenetrationResult truth = exact.Query(q), found = metric.Query(q);
    (truth.inside ? inside : outside) += 1.0;
    if (!truth.inside) {
      row->false_hits += found.inside ? 100.0 : 0.0;
      continue;
    }
    row->missed += found.inside ? 0.0 : 100.0;
    const double error =
        100.0 * std::abs(found.signed_distance - truth.signed_distance) /
        diagonal;
    errors += error;
    row->worst = std::max(row->worst, error);
  }
  row->mean = errors / std::max(1.0, inside);
  row->missed /= std::max(1.0, inside);
  row->false_hits /= std::max(1.0, outside);
}

}  // namespace

std::vector<ApproximationRow> MeasureApproximations(
    const TradeOptions& options) {
  constexpr int kPoints = 20000;
  std::vector<ApproximationRow> rows;
  for (const Pair& pair : Pairs()) {
    const ContactSpace exact = BuildContactSpace(pair.robot, pair.obstacle);
    const EuclideanMetric truth(exact);
    std::mt19937_64 random(options.seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Eigen::Vector3d size = exact.bounds().max - exact.bounds().min;
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < kPoints; ++i) {
      const Eigen::Vector3d share = RandomVector(&unit, &random);
      points.push_back(exact.bounds().min + size.cwiseProduct(share));
    }
    double base = 0.0;
    for (const Choice& choice : Choices()) {
      ContactSpaceOptions build;
      choice.apply(pair, &build);
      const double begin = CpuSeconds();
      const ContactSpace space =
          BuildContactSpace(pair.robot, pair.obstacle, build);
      const double seconds = CpuSeconds() - begin;
      if (rows.empty() || rows.back().pair != pair.name) base = seconds;
      ApproximationRow row;
      row.pair = pair.name;
      row.choice = choice.name;
      row.triangles = space.mesh().triangles.size();
      row.build = seconds / base;
      row.bound = 100.0 * space.report().approximation.bound / exact.length();
      Judge(truth, EuclideanMetric(space), points, exact.length(), &row);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace phongpd::bench
