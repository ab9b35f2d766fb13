// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/build_by_boxes.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/minkowski/cells/surface_join.h"
#include "core/minkowski/windows/window_cells.h"

namespace phongpd::internal {

std::vector<SurfacePiece> ArrangeBoxes(const std::vector<PlannedWindow>& boxes,
                                       const Convolution& convolution,
                                       const SolidCollision& judge,
                                       const BuildLimits& limits) {
  std::vector<SurfacePiece> pieces(boxes.size());
  tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t i) {
    tbb::this_task_arena::isolate([&] {
      pieces[i] = WindowCells(PartOf(convolution, boxes[i]), boxes[i].window,
                              judge, limits)
                      .Surface();
    });
  });
  return pieces;
}

void WriteJoinedSurface(const std::vector<SurfacePiece>& boxes, bool outer_only,
                        const GridFrame& frame, const BuildLimits* limits,
                        StageClock* clock, ContactSpace::Parts* out) {
  AssemblyOptions options;
  options.outer_only = outer_only;
  options.units_per_step = 2;
  const JoinedSurface joined = JoinPieces(boxes, options);
  ContactSpaceReport& report = out->report;
  for (const SurfacePiece& box : boxes) {
    report.arrangement_faces += box.arranged;
    report.cells += box.cells;
    report.judged_cells += box.judged;
  }
  ReportCavities(joined.cavities, outer_only, &report);
  WriteSurface(joined.surface, joined.sides, joined.groups, joined.points,
               frame, limits, clock, out);
}

}  // namespace phongpd::internal
