// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/contact/build_stages.h"
#include "core/contact/contact_space.h"
#include "core/contact/culled_build.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/cells.h"
#include "core/minkowski/convolution.h"
#include "core/minkowski/edge_rings.h"
#include "core/minkowski/facet_intersections.h"
#include "core/minkowski/grid_pair.h"
#include "core/minkowski/operand.h"
#include "core/minkowski/plane_arrangement.h"
#include "core/minkowski/plane_groups.h"
#include "core/minkowski/solid_collision.h"
#include "core/minkowski/surface_assembly.h"
#include "core/solid/solid.h"

namespace phongpd {
namespace {

// Of what a build does, this share goes faster with more threads.
constexpr double kParallelShare = 0.65;

double SpeedUp() {
  using tbb::global_control;
  const auto threads = static_cast<double>(std::min<std::size_t>(
      global_control::active_value(global_control::max_allowed_parallelism),
      static_cast<std::size_t>(
          std::max(1, tbb::this_task_arena::max_concurrency()))));
  return 1.0 / (1.0 - kParallelShare + kParallelShare / threads);
}

// Processor seconds of one thread: of arranging what is expected, and all that
// follows; of looking for what is occupied in a convolution of that many
// facets.  Fitted to the pairs of results/lazy/culling.csv and some twice as
// coarse.
double ArrangementSeconds(const internal::ExpectedCuts& cuts) {
  return 5.9e-6 * cuts.meetings + 8.8e-6 * cuts.crossings;
}
double CullingSeconds(std::size_t facets) {
  return 0.03 + 1.0e-5 * static_cast<double>(facets);
}

// As those; `whole` facets before culling.
PredictedCost Predict(std::size_t triangles, std::size_t whole, bool is_culled,
                      const internal::ExpectedCuts& cuts) {
  const auto operands = static_cast<double>(triangles);
  const auto facets = static_cast<double>(whole);
  PredictedCost cost;
  cost.meetings = cuts.meetings;
  cost.arrangement_faces = 0.39 * cuts.meetings + 0.95 * cuts.crossings;
  cost.seconds =
      (1.2e-6 * operands + (is_culled ? CullingSeconds(whole) : 0.0) +
       ArrangementSeconds(cuts)) /
      SpeedUp();
  cost.mib = 3.4 + 3.6e-4 * operands + 7.6e-5 * facets +
             4.4e-4 * cuts.meetings + 7.3e-4 * cuts.crossings;
  return cost;
}

// Facets of smooth and of small solids meet few others: hardly any of them are
// inside, and to find that out takes as long as to arrange them
// (results/lazy/culling.md).
bool IsWorthCulling(const internal::ExpectedCuts& cuts, std::size_t facets) {
  constexpr double kMuchSeconds = 0.22;
  constexpr double kMuchMore = 2.0;
  return ArrangementSeconds(cuts) >
         std::max(kMuchSeconds, kMuchMore * CullingSeconds(facets));
}

using internal::Culling;
using internal::CullingReport;
using internal::OperandRole;

// Operands are Solids or meshes.
template <typename Operand>
ContactSpace Build(const Operand& robot, const Operand& obstacle,
                   const ContactSpaceOptions& options, Culling culling,
                   CullingReport* culled) {
  ContactSpace::Parts out;
  ContactSpaceReport& report = out.report;
  internal::StageClock clock(&report);
  internal::BuildLimits limits(options);
  limits.ObserveCancellation();

  const Solid a =
      internal::PrepareOperand(robot, OperandRole::kRobot, options, &report);
  limits.Look("check");
  const Solid b = internal::PrepareOperand(obstacle, OperandRole::kObstacle,
                                           options, &report);
  limits.Look("check");
  clock.Finish("check");

  const internal::GridPair pair = internal::PlaceOperands(a, b, &report);
  limits.Look("grid");
  const internal::GridSolid& p = pair.obstacle;
  const internal::GridSolid& q = pair.reflected_robot;
  internal::DescribeGrid(pair, &report);
  internal::Convolution convolution =
      internal::ReducedConvolution(p, q, &limits);
  report.convolution_triangles = convolution.facets.size();
  clock.Finish("convolution");

  internal::PlaneGroups groups = internal::GroupAndName(&convolution);
  limits.Look("prediction");
  internal::ExactPoints points;
  internal::Arrangement arrangement;
  {
    auto index = std::make_unique<internal::FacetIndex>(convolution);
    limits.Look("prediction");
    internal::ExpectedCuts cuts =
        internal::ExpectCuts(convolution, groups, *index, limits);
    internal::OccupiedRegion occupied;
    culled->facets = convolution.facets.size();
    culled->meetings = culled->meetings_left = cuts.meetings;
    if (culling == Culling::kAlways ||
        (culling == Culling::kWhereItPays &&
         IsWorthCulling(cuts, convolution.facets.size()))) {
      occupied = internal::OccupiedRegion(p, q, convolution, limits);
      internal::DropOccupied(occupied, &convolution, &groups);
      index = std::make_unique<internal::FacetIndex>(convolution);
      cuts =
          internal::ExpectCuts(convolution, groups, *index, limits, &occupied);
      culled->was_tried = !occupied.IsEmpty();
      culled->dropped = culled->facets - convolution.facets.size();
      culled->meetings_left = cuts.meetings;
    }
    report.predicted =
        Predict(a.mesh().triangles.size() + b.mesh().triangles.size(),
                report.convolution_triangles, !occupied.IsEmpty(), cuts);
    limits.Predict(report.predicted);
    clock.Finish("prediction");
    const internal::FacetIntersections intersections =
        internal::IntersectFacets(convolution, groups, *index, limits, &points,
                                  &occupied);
    clock.Finish("intersection");
    arrangement = internal::ArrangePlanes(convolution, groups, intersections,
                                          limits, &points);
  }
  report.arrangement_faces = arrangement.faces.size();
  clock.Finish("arrangement");

  const internal::EdgeRings rings =
      internal::SortAroundEdges(convolution, arrangement, points, &limits);
  limits.Look("cells");
  const internal::SolidCollision judge(p, q);
  const internal::FreeCells cells = [&] {
    try {
      return internal::FindFreeCells(convolution, arrangement, rings, points,
                                     judge, limits);
    } catch (const internal::LeakError&) {
      if (pair.IsRounded()) {
        internal::RefuseLostFacets(p, b, q, a, pair.frame.step);
      }
      throw;
    }
  }();
  report.cells = static_cast<std::size_t>(cells.cells);
  report.judged_cells = static_cast<std::size_t>(cells.judged);
  report.cavities = cells.cavities;
  if (options.outer_shell_only) {
    ApproximationStep step;
    step.kind = "outer-shell";
    step.dropped_cavities = cells.cavities;
    internal::AddStep(step, &report.approximation);
  }
  clock.Finish("cells");

  limits.Look("surface");
  const internal::PatchSurface patches = internal::AssembleSurface(
      arrangement, groups, rings, cells,
      {options.merge_coplanar, options.outer_shell_only, 1, &limits}, &points);
  limits.Look("surface");
  internal::WriteSurface(patches, convolution, groups, points, pair.frame,
                         &limits, &clock, &out);
  return ContactSpace(std::move(out));
}

}  // namespace

ContactSpace BuildContactSpace(const Solid& robot, const Solid& obstacle,
                               const ContactSpaceOptions& options) {
  CullingReport culled;
  return Build(robot, obstacle, internal::WithNames(options, robot, obstacle),
               Culling::kWhereItPays, &culled);
}

ContactSpace BuildContactSpace(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const ContactSpaceOptions& options) {
  CullingReport culled;
  return internal::BuildCulled(robot, obstacle, options, Culling::kWhereItPays,
                               &culled);
}

ContactSpace internal::BuildCulled(const TriangleMesh& robot,
                                   const TriangleMesh& obstacle,
                                   const ContactSpaceOptions& options,
                                   Culling culling, CullingReport* report) {
  return Build(robot, obstacle, options, culling, report);
}

}  // namespace phongpd
