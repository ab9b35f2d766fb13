// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/optimize_by_windows.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/projection/window_metric.h"
#include "core/stopwatch.h"
#include "planners/exact/path_shortening.h"
#include "planners/solve/optimize_in_free_space.h"

namespace phongpd::internal {
namespace {

// None where nothing can be touched.
std::shared_ptr<const WindowMetric> MetricOf(const World& world,
                                             const OptimizeRequest& request) {
  const std::vector<ConvolutionModel>& models = world.Convolution().models;
  if (models.empty()) return nullptr;
  const PenetrationSpec& spec = request.penetration;
  return world.Kept<WindowMetric>(spec.Name(), [&] {
    if (spec.metric == MetricKind::kEuclidean) {
      return WindowMetric(models.front());
    }
    return WindowMetric(
        models.front(), world.Resolve(spec.smoothing_length).share,
        world.diagonal(),
        spec.metric == MetricKind::kSmoothedFoot ? SmoothedAt::kContact
                                                 : SmoothedAt::kPosition);
  });
}

WindowUse Added(const WindowUse& before, WindowUse now) {
  now.boxes -= before.boxes;
  now.faces -= before.faces;
  now.inside -= before.inside;
  now.extensions -= before.extensions;
  now.seconds -= before.seconds;
  return now;
}

// As StartRepair answers, but that nothing proves that there is no way.
StartRepairResult SearchStarts(const TrajectoryProblem& problem,
                               const MotionDomain& domain, double seconds,
                               const StartRepairOptions& wished) {
  const Stopwatch stopwatch;
  StartRepairResult result;
  const Path line = StraightPath(problem);
  if (CheckPath(*problem.free_space, line).free) {
    result.status = RepairStatus::kFree;
    result.routes.push_back(line);
  } else {
    for (int route = 0; route < wished.routes; ++route) {
      SearchedWay way =
          SearchWay(problem, domain, seconds,
                    wished.seed + static_cast<std::uint64_t>(route));
      ++result.searches;
      if (way.path.empty()) {
        result.reason = std::move(way.reason);
      } else {
        result.routes.push_back(std::move(way.path));
      }
    }
    std::stable_sort(result.routes.begin(), result.routes.end(),
                     [](const Path& a, const Path& b) {
                       return PathLength(a) < PathLength(b);
                     });
    result.runs = 1;
    if (!result.routes.empty()) {
      result.status = RepairStatus::kRepaired;
      result.reason.clear();
    }
  }
  result.seconds = stopwatch.Seconds();
  return result;
}

}  // namespace

bool HasWindowMetric(const OptimizeRequest& request) {
  return request.penetration.metric != MetricKind::kPhong &&
         !request.own_metric && !request.is_per_obstacle &&
         request.options.optimizer.rows == 1;
}

PipelineResult OptimizeByWindows(const World& world,
                                 const OptimizeRequest& request,
                                 TrajectoryProblem problem,
                                 const MotionDomain& domain,
                                 std::optional<WindowUse>* use) {
  const std::shared_ptr<const WindowMetric> metric = MetricOf(world, request);
  const WindowUse before = metric ? metric->Use() : WindowUse();
  if (metric) {
    problem.metrics.push_back(std::make_shared<SignedMetric>(
        metric, request.penetration.Options(world.diagonal())));
  }
  const OwnStarts starts{[&](const StartRepairOptions& wished) {
    const double seconds =
        std::min(request.search_time, request.options.time_limit);
    return SearchStarts(problem, domain, seconds, wished);
  }};
  PipelineResult result =
      TrajectoryPipeline(problem, starts, request.options).Solve();
  *use = metric ? Added(before, metric->Use()) : WindowUse();
  return result;
}

}  // namespace phongpd::internal
