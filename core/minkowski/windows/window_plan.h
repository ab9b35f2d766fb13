// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/convolution/occupied_region.h"
#include "core/minkowski/convolution/window_convolution.h"
#include "core/minkowski/windows/grid_window.h"

namespace phongpd::internal {

// A window and the facets of the convolution that meet it.
struct PlannedWindow {
  GridWindow window;
  std::vector<int> facets;
};

// Windows that fill the box of all sums but for boxes that are occupied or meet
// no facet: halved where they meet more than `most_facets`, as long as that
// makes fewer of them.  The same for the same convolution.
std::vector<PlannedWindow> PlanWindows(const Convolution& convolution,
                                       const OccupiedRegion& occupied,
                                       std::size_t most_facets);

// Of these facets of the convolution those that meet a box, and perhaps some
// that do not.
std::vector<int> FacetsIn(const Convolution& convolution,
                          const std::vector<int>& facets,
                          const BoundingBox& box);

// The part of the convolution that a window is to be built from.
WindowConvolution PartOf(const Convolution& convolution,
                         const PlannedWindow& window);

}  // namespace phongpd::internal
