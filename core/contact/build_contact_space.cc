// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>

#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "core/contact/contact_space.h"
#include "core/contact/surface_description.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/cells.h"
#include "core/minkowski/convolution.h"
#include "core/minkowski/edge_rings.h"
#include "core/minkowski/facet_intersections.h"
#include "core/minkowski/grid_pair.h"
#include "core/minkowski/operand.h"
#include "core/minkowski/patch_triangulation.h"
#include "core/minkowski/plane_arrangement.h"
#include "core/minkowski/plane_groups.h"
#include "core/minkowski/solid_collision.h"
#include "core/minkowski/surface_assembly.h"
#include "core/minkowski/zero_edges.h"
#include "core/solid/solid.h"
#include "core/stopwatch.h"

namespace phongpd {
namespace {

// Writes the wall time since the last call under the name of a stage.
class StageClock {
 public:
  explicit StageClock(ContactSpaceReport* report) : report_(report) {}
  void Finish(const std::string& stage) {
    report_->seconds.emplace_back(stage, stopwatch_.Seconds());
    stopwatch_ = Stopwatch();
  }

 private:
  ContactSpaceReport* report_;
  Stopwatch stopwatch_;
};

double PeakMib() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Fitted to solids of 12 to 20,000 triangles on 2 cores; coplanar solids have
// far fewer faces and take as long.
PredictedCost Predict(const internal::Convolution& convolution,
                      double meetings) {
  const double facets = static_cast<double>(convolution.facets.size());
  PredictedCost cost;
  cost.meetings = meetings;
  cost.arrangement_faces = 0.75 * meetings;
  cost.seconds = 3e-6 * facets + 5.5e-6 * meetings;
  cost.mib = 5.0 + 3e-4 * facets + 8e-4 * meetings;
  return cost;
}

// Rounds the exact surface into the user's frame.
void RoundSurface(const internal::ExactSurface& surface,
                  const internal::ExactPoints& points,
                  const internal::GridFrame& frame,
                  const internal::Convolution& convolution,
                  const internal::PlaneGroups& groups,
                  ContactSpace::Parts* out) {
  for (const int id : surface.vertex_points) {
    out->mesh.vertices.push_back(
        frame.ToUser(internal::WithExactIntegers(points[id])));
  }
  out->mesh.triangles = surface.triangles;
  // Planes that made it to the surface, numbered by first appearance.
  std::unordered_map<int, int> plane_ids;
  out->plane.reserve(surface.facet.size());
  out->kind.reserve(surface.facet.size());
  for (const int facet : surface.facet) {
    const int key = 2 * groups.of_facet[facet] + groups.reversed[facet];
    const int next = static_cast<int>(plane_ids.size());
    out->plane.push_back(plane_ids.emplace(key, next).first->second);
    out->kind.push_back(convolution.facets[facet].kind);
  }
}

// Distinct exact points may round to one.
void RemoveZeroEdges(ContactSpace::Parts* space) {
  const std::vector<int> kept = internal::CollapseZeroEdges(&space->mesh);
  for (std::size_t t = 0; t < kept.size(); ++t) {
    space->plane[t] = space->plane[kept[t]];
    space->kind[t] = space->kind[kept[t]];
  }
  space->plane.resize(kept.size());
  space->kind.resize(kept.size());
}

using internal::OperandRole;

// Operands are Solids or meshes.
template <typename Operand>
ContactSpace Build(const Operand& robot, const Operand& obstacle,
                   const ContactSpaceOptions& options) {
  ContactSpace::Parts out;
  ContactSpaceReport& report = out.report;
  StageClock clock(&report);
  internal::BuildLimits limits(options);
  limits.ObserveCancellation();

  const Solid a =
      internal::PrepareOperand(robot, OperandRole::kRobot, options, &report);
  const Solid b = internal::PrepareOperand(obstacle, OperandRole::kObstacle,
                                           options, &report);
  clock.Finish("check");

  const internal::GridPair pair = internal::PlaceOperands(a, b, &report);
  const internal::GridFrame& frame = pair.frame;
  const internal::GridSolid& p = pair.obstacle;
  const internal::GridSolid& q = pair.reflected_robot;
  report.canonical_frame = frame.is_turned;
  report.grid_step = frame.rounding;
  const bool is_rounded = pair.IsRounded();
  const internal::Convolution convolution = internal::ReducedConvolution(p, q);
  report.convolution_triangles = convolution.facets.size();
  clock.Finish("convolution");

  const internal::PlaneGroups groups = internal::GroupByPlane(convolution);
  internal::ExactPoints points;
  internal::Arrangement arrangement;
  {
    const internal::FacetIndex index(convolution);
    report.predicted = Predict(
        convolution, internal::PredictMeetings(convolution, groups, index));
    limits.Predict(report.predicted);
    clock.Finish("prediction");
    const internal::FacetIntersections intersections =
        internal::IntersectFacets(convolution, groups, index, limits, &points);
    clock.Finish("intersection");
    arrangement = internal::ArrangePlanes(convolution, groups, intersections,
                                          limits, &points);
  }
  report.arrangement_faces = arrangement.faces.size();
  clock.Finish("arrangement");

  const internal::EdgeRings rings =
      internal::SortAroundEdges(convolution, arrangement, points);
  const internal::SolidCollision judge(p, q);
  const internal::FreeCells cells = [&] {
    try {
      return internal::FindFreeCells(convolution, arrangement, rings, points,
                                     judge, limits);
    } catch (const internal::LeakError&) {
      if (is_rounded) {
        internal::RefuseLostFacets(p, b, q, a, frame.step);
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

  const internal::PatchSurface patches = internal::AssembleSurface(
      arrangement, groups, rings, cells,
      {options.merge_coplanar, options.outer_shell_only}, &points);
  const internal::ExactSurface surface =
      internal::TriangulatePatches(patches, convolution, points);
  RoundSurface(surface, points, frame, convolution, groups, &out);
  RemoveZeroEdges(&out);
  clock.Finish("surface");

  internal::DescribeSurface(out.mesh, &report);
  report.peak_mib = PeakMib();
  clock.Finish("report");
  return ContactSpace(std::move(out));
}

}  // namespace

ContactSpace BuildContactSpace(const Solid& robot, const Solid& obstacle,
                               const ContactSpaceOptions& options) {
  return Build(robot, obstacle, internal::WithNames(options, robot, obstacle));
}

ContactSpace BuildContactSpace(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const ContactSpaceOptions& options) {
  return Build(robot, obstacle, options);
}

}  // namespace phongpd
