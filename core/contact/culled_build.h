// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/contact/contact_space.h"

// For tests and benchmarks: what culling does to a build, which to its result
// is nothing.
namespace phongpd::internal {

// Are facets that are occupied all over left out before they are arranged?
enum class Culling { kWhereItPays, kNever, kAlways };

struct CullingReport {
  bool was_tried = false;
  std::size_t facets = 0;   // of the convolution
  std::size_t dropped = 0;  // of them
  double meetings = 0.0;    // predicted, before and
  double meetings_left = 0.0;
};

// BuildContactSpace with `culling` as asked for.
ContactSpace BuildCulled(const TriangleMesh& robot,
                         const TriangleMesh& obstacle,
                         const ContactSpaceOptions& options, Culling culling,
                         CullingReport* report);

}  // namespace phongpd::internal
