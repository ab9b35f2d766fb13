// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/contact/contact_space.h"
#include "core/minkowski/arrangement/plane_groups.h"
#include "core/minkowski/cells/surface_assembly.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/convolution/occupied_region.h"
#include "core/minkowski/operands/exact_points.h"
#include "core/minkowski/operands/grid_frame.h"
#include "core/minkowski/operands/grid_pair.h"
#include "core/stopwatch.h"

// What builds of a contact space share, whole or by pieces.
namespace phongpd::internal {

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

// Of this process so far.
double PeakMib();

// Says what grid the operands are on.
void DescribeGrid(const GridPair& pair, ContactSpaceReport* report);

// The groups of the convolution's planes; gives all facets of one oriented
// plane the kind of the first, which a triangle of it then has whichever of
// them are arranged.
PlaneGroups GroupAndName(Convolution* convolution);

// Leaves out the facets that are occupied all over.
void DropOccupied(const OccupiedRegion& occupied, Convolution* convolution,
                  PlaneGroups* groups);

// Bounded free cells, and that they were dropped if only the outer shell is
// asked for.
void ReportCavities(int cavities, bool outer_only, ContactSpaceReport* report);

// Triangulates the surface and rounds it into the user's frame.  What `sides`
// and `groups` are of need not be all facets that were arranged.  The report is
// to be finished.  Throws BuildRefusal when `limits`, if there are any, are
// passed.
void WriteSurface(const PatchSurface& surface, const Convolution& sides,
                  const PlaneGroups& groups, const ExactPoints& points,
                  const GridFrame& frame, const BuildLimits* limits,
                  StageClock* clock, ContactSpace::Parts* out);

// What the report says of the finished surface.  Looks at triangles in
// pairs: not for surfaces that nobody asks about.
void FinishReport(StageClock* clock, ContactSpace::Parts* out);

}  // namespace phongpd::internal
