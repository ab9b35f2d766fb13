// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/build_stages.h"

#include <sys/resource.h>
#include <tbb/parallel_for.h>

#include <numeric>
#include <unordered_map>
#include <vector>

#include "core/contact/surface_description.h"
#include "core/minkowski/arrangement/zero_edges.h"
#include "core/minkowski/cells/patch_triangulation.h"
#include "core/minkowski/operands/operand.h"

namespace phongpd::internal {
namespace {

// Rounds the exact surface into the user's frame.
void RoundSurface(const ExactSurface& surface, const GridFrame& frame,
                  const Convolution& convolution, const PlaneGroups& groups,
                  ContactSpace::Parts* out) {
  for (const Eigen::Vector3d& position : surface.positions) {
    out->mesh.vertices.push_back(frame.ToUser(position));
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
  const std::vector<int> kept = CollapseZeroEdges(&space->mesh);
  for (std::size_t t = 0; t < kept.size(); ++t) {
    space->plane[t] = space->plane[kept[t]];
    space->kind[t] = space->kind[kept[t]];
  }
  space->plane.resize(kept.size());
  space->kind.resize(kept.size());
}

}  // namespace

double PeakMib() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void DescribeGrid(const GridPair& pair, ContactSpaceReport* report) {
  report->canonical_frame = pair.frame.is_turned;
  report->grid_step = pair.frame.rounding;
}

PlaneGroups GroupAndName(Convolution* convolution) {
  PlaneGroups groups = GroupByPlane(*convolution);
  std::vector<ConvolutionFacet>& facets = convolution->facets;
  std::vector<int> first(2 * groups.members.size(), -1);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    int& of_side = first[2 * groups.of_facet[f] + groups.reversed[f]];
    if (of_side < 0) of_side = static_cast<int>(f);
    facets[f].kind = facets[of_side].kind;
  }
  return groups;
}

void DropOccupied(const OccupiedRegion& occupied, Convolution* convolution,
                  PlaneGroups* groups) {
  std::vector<ConvolutionFacet>& facets = convolution->facets;
  std::vector<char> dropped(facets.size());
  tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t f) {
    Eigen::Vector3d corners[3];
    for (int k = 0; k < 3; ++k) {
      corners[k] = ToDouble(convolution->points[facets[f].corners[k]]);
    }
    dropped[f] = occupied.Contains(corners);
  });
  PlaneGroups kept;
  std::vector<int> numbers(groups->members.size(), -1);
  std::size_t count = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (dropped[f]) continue;
    int& group = numbers[groups->of_facet[f]];
    if (group < 0) {
      group = static_cast<int>(kept.members.size());
      kept.members.emplace_back();
      kept.planes.push_back(groups->planes[groups->of_facet[f]]);
    }
    kept.members[group].push_back(static_cast<int>(count));
    kept.of_facet.push_back(group);
    kept.reversed.push_back(groups->reversed[f]);
    facets[count++] = facets[f];
  }
  facets.resize(count);
  *groups = std::move(kept);
}

void ReportCavities(int cavities, bool outer_only, ContactSpaceReport* report) {
  report->cavities = cavities;
  if (!outer_only) return;
  ApproximationStep step;
  step.kind = ApproximationKind::kOuterShell;
  step.dropped_cavities = cavities;
  AddStep(step, &report->approximation);
}

void WriteSurface(const PatchSurface& surface, const Convolution& sides,
                  const PlaneGroups& groups, const ExactPoints& points,
                  const GridFrame& frame, const BuildLimits* limits,
                  StageClock* clock, ContactSpace::Parts* out) {
  RoundSurface(TriangulatePatches(surface, sides, points, limits), frame, sides,
               groups, out);
  RemoveZeroEdges(out);
  if (limits != nullptr) limits->CheckNow("surface");
  clock->Finish("surface");
}

void FinishReport(StageClock* clock, ContactSpace::Parts* out) {
  DescribeSurface(out->mesh, &out->report);
  out->report.peak_mib = PeakMib();
  clock->Finish("report");
}

}  // namespace phongpd::internal
