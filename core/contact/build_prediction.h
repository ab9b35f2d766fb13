// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/minkowski/arrangement/facet_intersections.h"
#include "core/minkowski/contact_space_report.h"

// What a build will cost, before it is done.  Fitted to the pairs of
// results/lazy; the report's word is a guide, BuildLimits is what holds.
namespace phongpd::internal {

// What is known of a build once its facets have been sampled.
struct BuildSample {
  std::size_t triangles = 0;  // of both operands
  std::size_t facets = 0;     // of the convolution, before culling
  bool is_culled = false;
  ExpectedCuts cuts;  // of what is left to arrange
};

// Facets of smooth and of small solids meet few others: hardly any of them are
// inside, and to find that out takes as long as to arrange them
// (results/lazy/culling.md).
bool IsWorthCulling(const ExpectedCuts& cuts, std::size_t facets);

// Of a build in one piece, and of one by boxes that are arranged one after the
// other (build_by_boxes.h), in which the arrangement takes no memory to speak
// of beside facets and surface.
PredictedCost PredictWhole(const BuildSample& sample);
PredictedCost PredictByBoxes(const BuildSample& sample);

}  // namespace phongpd::internal
