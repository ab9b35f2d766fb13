// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/plane_groups.h"

#include <tbb/parallel_for.h>

#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace phongpd::internal {
namespace {

// n·x = offset with coprime n whose first non-zero component is positive.
struct PlaneKey {
  std::array<Int128, 4> value;
  bool operator==(const PlaneKey& o) const { return value == o.value; }
};

struct PlaneKeyHash {
  std::size_t operator()(const PlaneKey& key) const {
    std::uint64_t h = 0;
    for (const Int128 x : key.value) {
      for (const auto part : {static_cast<std::uint64_t>(x),
                              static_cast<std::uint64_t>(x >> 64)}) {
        h = (h ^ part) * 0x9E3779B97F4A7C15ULL;
        h ^= h >> 31;
      }
    }
    return static_cast<std::size_t>(h);
  }
};

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

PlaneKey KeyOf(const GridNormal& normal, const GridPoint& p, char* reversed) {
  GridNormal n = normal;
  const Int128 divisor = Gcd(Gcd(n[0], n[1]), n[2]);
  for (Int128& x : n) x /= divisor;
  const Int128 lead = n[0] != 0 ? n[0] : n[1] != 0 ? n[1] : n[2];
  *reversed = lead < 0;
  if (*reversed) n = Negated(n);
  return {{n[0], n[1], n[2], Dot(n, p)}};
}

}  // namespace

PlaneGroups GroupByPlane(const Convolution& convolution) {
  const std::size_t count = convolution.facets.size();
  PlaneGroups groups;
  groups.of_facet.resize(count);
  groups.reversed.resize(count);
  std::vector<PlaneKey> keys(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t f) {
    const ConvolutionFacet& facet = convolution.facets[f];
    keys[f] = KeyOf(facet.normal, convolution.points[facet.corners[0]],
                    &groups.reversed[f]);
  });
  std::unordered_map<PlaneKey, int, PlaneKeyHash> ids;
  for (std::size_t f = 0; f < count; ++f) {
    const auto [it, is_new] =
        ids.emplace(keys[f], static_cast<int>(groups.members.size()));
    if (is_new) groups.members.emplace_back();
    groups.of_facet[f] = it->second;
    groups.members[it->second].push_back(static_cast<int>(f));
  }
  return groups;
}

}  // namespace phongpd::internal
