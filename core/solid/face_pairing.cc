// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/face_pairing.h"

#include <utility>

#include "core/mesh/edge_sides.h"

namespace phongpd::internal {
std::size_t CountUnpairedEdges(const Faces& faces) {
  const std::vector<EdgeSide> edges =
      SortedEdgeSides(faces, FoldedTriangles::kLeftOut);
  std::size_t bad = 0;
  ForEachEdge(edges, [&bad](std::size_t begin, std::size_t end) {
    bad += end - begin != 2;
  });
  return bad;
}

std::size_t OrientAlike(Faces* faces) {
  std::size_t all_turned = 0;
  struct Link {
    int face;
    bool is_turned;  // runs through the edge in the same direction
  };
  std::vector<std::vector<Link>> links(faces->size());
  const std::vector<EdgeSide> edges =
      SortedEdgeSides(*faces, FoldedTriangles::kLeftOut);
  ForEachEdge(edges, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const EdgeSide &a = edges[begin], &b = edges[begin + 1];
    const bool is_turned = a.is_forward == b.is_forward;
    links[a.triangle].push_back({b.triangle, is_turned});
    links[b.triangle].push_back({a.triangle, is_turned});
  });
  std::vector<int> side(faces->size(), -1);
  for (std::size_t seed = 0; seed < faces->size(); ++seed) {
    if (side[seed] >= 0) continue;
    std::vector<int> part = {static_cast<int>(seed)};
    side[seed] = 0;
    bool is_orientable = true;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const Link& link : links[part[i]]) {
        const int expected = side[part[i]] ^ (link.is_turned ? 1 : 0);
        if (side[link.face] < 0) {
          side[link.face] = expected;
          turned += static_cast<std::size_t>(expected);
          part.push_back(link.face);
        }
        is_orientable = is_orientable && side[link.face] == expected;
      }
    }
    if (!is_orientable) continue;
    const int minority = 2 * turned > part.size() ? 0 : 1;
    for (const int f : part) {
      if (side[f] != minority) continue;
      std::swap((*faces)[f][1], (*faces)[f][2]);
      ++all_turned;
    }
  }
  return all_turned;
}

}  // namespace phongpd::internal
