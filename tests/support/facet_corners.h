// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <set>

#include "core/minkowski/convolution/convolution.h"

namespace phongpd::testing {

// A facet by its corners in their order, the least first.
using FacetCorners = std::array<internal::GridPoint, 3>;

inline FacetCorners CornersOf(const internal::Convolution& c,
                              const internal::ConvolutionFacet& f) {
  FacetCorners t;
  for (std::size_t k = 0; k < 3; ++k) {
    t[k] = c.points[static_cast<std::size_t>(f.corners[k])];
  }
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

inline std::set<FacetCorners> AllCorners(const internal::Convolution& c) {
  std::set<FacetCorners> all;
  for (const auto& f : c.facets) all.insert(CornersOf(c, f));
  return all;
}

// Is a point of a fine sampling of the facet within the box?  By another route
// than IsClearlyApart.
inline bool IsSeenIn(const FacetCorners& t, const BoundingBox& box) {
  constexpr int kSteps = 20;
  for (int u = 0; u <= kSteps; ++u) {
    for (int v = 0; u + v <= kSteps; ++v) {
      const Eigen::Vector3d x =
          (u * internal::ToDouble(t[0]) + v * internal::ToDouble(t[1]) +
           (kSteps - u - v) * internal::ToDouble(t[2])) /
          kSteps;
      if ((x.array() > box.min.array()).all() &&
          (x.array() < box.max.array()).all()) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace phongpd::testing
