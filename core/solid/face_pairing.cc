// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/face_pairing.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace phongpd::internal {
namespace {

bool UsesVertexTwice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

struct HalfEdge {
  int low, high;
  int face;
  bool is_forward;
};

std::vector<HalfEdge> SortedHalfEdges(const Faces& faces) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (UsesVertexTwice(faces[f])) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = faces[f][k], b = faces[f][(k + 1) % 3];
      edges.push_back(
          {std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const HalfEdge& a, const HalfEdge& b) {
              return std::tie(a.low, a.high, a.face) <
                     std::tie(b.low, b.high, b.face);
            });
  return edges;
}

// Calls visit(first, last) for the half-edges of every edge.
template <typename Visit>
void ForEachEdge(const std::vector<HalfEdge>& edges, const Visit& visit) {
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end].low == edges[i].low &&
           edges[end].high == edges[i].high) {
      ++end;
    }
    visit(i, end);
  }
}

}  // namespace

std::size_t CountUnpairedEdges(const Faces& faces) {
  const std::vector<HalfEdge> edges = SortedHalfEdges(faces);
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
  const std::vector<HalfEdge> edges = SortedHalfEdges(*faces);
  ForEachEdge(edges, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const HalfEdge &a = edges[begin], &b = edges[begin + 1];
    const bool is_turned = a.is_forward == b.is_forward;
    links[a.face].push_back({b.face, is_turned});
    links[b.face].push_back({a.face, is_turned});
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
