// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/contact/contact_space.h"

// For tests and benchmarks: ways to build that a build chooses by itself, and
// that change nothing of its result.
namespace phongpd::internal {

// Are facets that are occupied all over left out before they are arranged?
enum class Culling { kWhereItPays, kNever, kAlways };

// Is the arrangement done by boxes (build_by_boxes.h)?
enum class Boxes { kWhereMemoryEnds, kAlways };

struct BuildSwitches {
  Culling culling = Culling::kWhereItPays;
  Boxes boxes = Boxes::kWhereMemoryEnds;
  std::size_t facets_of_box = 0;  // 0: as ever
};

struct CullingReport {
  bool was_tried = false;
  std::size_t facets = 0;   // of the convolution
  std::size_t dropped = 0;  // of them
  double meetings = 0.0;    // predicted, before and
  double meetings_left = 0.0;
};

// BuildContactSpace as asked for; `report` may be null.
ContactSpace BuildSwitched(const TriangleMesh& robot,
                           const TriangleMesh& obstacle,
                           const ContactSpaceOptions& options,
                           const BuildSwitches& switches,
                           CullingReport* report = nullptr);

}  // namespace phongpd::internal
