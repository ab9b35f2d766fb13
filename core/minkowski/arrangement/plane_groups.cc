// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/arrangement/plane_groups.h"

#include <tbb/parallel_for.h>

#include <cassert>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace phongpd::internal {
namespace {

Int128 Gcd(Int128 a, Int128 b) {
  a = a < 0 ? -a : a;
  b = b < 0 ? -b : b;
  constexpr Int128 kNarrow = std::numeric_limits<std::int64_t>::max();
  while (b != 0) {
    if (a <= kNarrow && b <= kNarrow) {  // 64-bit division is far cheaper
      return std::gcd(static_cast<std::int64_t>(a),
                      static_cast<std::int64_t>(b));
    }
    a %= b;
    std::swap(a, b);
  }
  return a;
}

GridPlane PlaneOf(const GridNormal& normal, const GridPoint& p,
                  char* reversed) {
  GridNormal n = normal;
  const Int128 divisor = Gcd(Gcd(n[0], n[1]), n[2]);
  for (Int128& x : n) x /= divisor;
  const Int128 lead = n[0] != 0 ? n[0] : n[1] != 0 ? n[1] : n[2];
  assert(lead != 0);  // the facet has area
  *reversed = lead < 0;
  if (*reversed) n = Negated(n);
  return {n, Dot(n, p)};
}

// Do all three corners lie on the plane, not only the one it was made from?
[[maybe_unused]] bool IsOnPlane(const Convolution& convolution, std::size_t f,
                                const GridPlane& plane) {
  for (const int corner : convolution.facets[f].corners) {
    if (Dot(plane.normal, convolution.points[corner]) != plane.offset) {
      return false;
    }
  }
  return true;
}

}  // namespace

GridPlane Coprime(GridPlane plane) {
  GridNormal& n = plane.normal;
  Int128 divisor = Gcd(Gcd(Gcd(n[0], n[1]), n[2]), plane.offset);
  if ((n[0] != 0 ? n[0] : n[1] != 0 ? n[1] : n[2]) < 0) divisor = -divisor;
  for (Int128& x : n) x /= divisor;
  plane.offset /= divisor;
  return plane;
}

PlaneGroups GroupByPlane(const Convolution& convolution) {
  const std::size_t count = convolution.facets.size();
  PlaneGroups groups;
  groups.of_facet.resize(count);
  groups.reversed.resize(count);
  std::vector<GridPlane> planes(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t f) {
    const ConvolutionFacet& facet = convolution.facets[f];
    planes[f] = PlaneOf(facet.normal, convolution.points[facet.corners[0]],
                        &groups.reversed[f]);
  });
  std::unordered_map<GridPlane, int, GridPlaneHash> ids;
  for (std::size_t f = 0; f < count; ++f) {
    const auto [it, is_new] =
        ids.emplace(planes[f], static_cast<int>(groups.members.size()));
    if (is_new) {
      groups.members.emplace_back();
      groups.planes.push_back(planes[f]);
    }
    groups.of_facet[f] = it->second;
    assert(IsOnPlane(convolution, f, planes[f]));
    groups.members[it->second].push_back(static_cast<int>(f));
  }
  return groups;
}

}  // namespace phongpd::internal
