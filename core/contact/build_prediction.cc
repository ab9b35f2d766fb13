// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/build_prediction.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace phongpd::internal {
namespace {

// Of what a build does, this share goes faster with more threads.
constexpr double kParallelShare = 0.65;

double Threads() {
  using tbb::global_control;
  return static_cast<double>(std::min<std::size_t>(
      global_control::active_value(global_control::max_allowed_parallelism),
      static_cast<std::size_t>(
          std::max(1, tbb::this_task_arena::max_concurrency()))));
}

// Processor seconds of one thread: of arranging what is expected, and all that
// follows; of looking for what is occupied in a convolution of that many
// facets.  Fitted to the pairs of results/lazy/culling.csv and some twice as
// coarse.
double ArrangementSeconds(const ExpectedCuts& cuts) {
  return 5.9e-6 * cuts.meetings + 8.8e-6 * cuts.crossings;
}
double CullingSeconds(std::size_t facets) {
  return 0.03 + 1.0e-5 * static_cast<double>(facets);
}

}  // namespace

bool IsWorthCulling(const ExpectedCuts& cuts, std::size_t facets) {
  constexpr double kMuchSeconds = 0.22;
  constexpr double kMuchMore = 2.0;
  return ArrangementSeconds(cuts) >
         std::max(kMuchSeconds, kMuchMore * CullingSeconds(facets));
}

PredictedCost PredictWhole(const BuildSample& sample) {
  const auto operands = static_cast<double>(sample.triangles);
  const auto facets = static_cast<double>(sample.facets);
  const ExpectedCuts& cuts = sample.cuts;
  PredictedCost cost;
  cost.meetings = cuts.meetings;
  cost.arrangement_faces = 0.39 * cuts.meetings + 0.95 * cuts.crossings;
  cost.seconds = (1.2e-6 * operands +
                  (sample.is_culled ? CullingSeconds(sample.facets) : 0.0) +
                  ArrangementSeconds(cuts)) /
                 (1.0 - kParallelShare + kParallelShare / Threads());
  cost.mib = 3.4 + 3.6e-4 * operands + 7.6e-5 * facets +
             4.4e-4 * cuts.meetings + 7.3e-4 * cuts.crossings;
  return cost;
}

PredictedCost PredictByBoxes(const BuildSample& sample) {
  PredictedCost cost = PredictWhole(sample);
  cost.seconds *= 1.15;
  // The faces stand for the surface, which nobody knows yet.
  cost.mib = 3.4 + 3.6e-4 * static_cast<double>(sample.triangles) +
             3.2e-4 * static_cast<double>(sample.facets) +
             2.9e-4 * cost.arrangement_faces;
  return cost;
}

}  // namespace phongpd::internal
