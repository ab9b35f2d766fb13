// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/pi.h"

// Volumes and topology of Minkowski sums that can be written down.
namespace phongpd::testing {

// A convex solid whose section at height z is a polygon Q times `scale`,
// linear in between; z ascending.
struct Ring {
  double z, scale;
};

// c₀ + c₁ s + c₂ s², the area of P ⊕ s·Q.
using SectionArea = std::array<double, 3>;

inline double AreaAt(const SectionArea& area, double s) {
  return area[0] + s * (area[1] + s * area[2]);
}

// ∫ area dz between two rings, by Simpson's rule, exact for cubics.
inline double Slice(const SectionArea& area, const Ring& a, const Ring& b) {
  return (b.z - a.z) / 6 *
         (AreaAt(area, a.scale) + 4 * AreaAt(area, (a.scale + b.scale) / 2) +
          AreaAt(area, b.scale));
}

// Of (P × [0, height]) ⊕ K: K cut at its widest, the prism between.
inline double VolumeOfPrismSum(const SectionArea& area, double height,
                               const std::vector<Ring>& k) {
  double volume = 0, widest = 0;
  for (const Ring& ring : k) widest = std::max(widest, ring.scale);
  for (std::size_t i = 1; i < k.size(); ++i)
    volume += Slice(area, k[i - 1], k[i]);
  return volume + height * AreaAt(area, widest);
}

// Of MakeUvBall: rings at whole multiples of π/parallels; or, with `phase` ½,
// between them, with flat caps.
inline std::vector<Ring> BallRings(double radius, int parallels, double phase) {
  std::vector<Ring> rings;
  for (double i = phase; i <= parallels; i += 1) {
    const double angle = kPi * (1 - i / parallels);
    rings.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return rings;
}

// Solid of those sections over the regular polygon, flat at both ends.
inline TriangleMesh MakeLathe(const std::vector<Ring>& rings, int sides) {
  TriangleMesh mesh;
  for (const Ring& ring : rings)
    for (int i = 0; i < sides; ++i)
      mesh.vertices.push_back({ring.scale * std::cos(2 * kPi * i / sides),
                               ring.scale * std::sin(2 * kPi * i / sides),
                               ring.z});
  const int top = static_cast<int>(rings.size() - 1) * sides;
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    for (int at = 0; at < top; at += sides) {
      mesh.triangles.push_back({at + i, at + j, at + sides + j});
      mesh.triangles.push_back({at + i, at + sides + j, at + sides + i});
    }
  }
  for (int i = 2; i < sides; ++i) {
    mesh.triangles.push_back({0, i, i - 1});
    mesh.triangles.push_back({top, top + i - 1, top + i});
  }
  return mesh;
}

struct IntegerBox {
  std::array<int, 3> min, max;
};

struct Counted {
  double volume;
  int euler;  // χ of the solid: pieces − tunnels + cavities
};

// The union of the boxes grown by `e` on all sides, from the cells of the grid
// that their planes span.
inline Counted CountUnion(std::vector<IntegerBox> boxes, int e) {
  std::array<std::vector<int>, 3> cuts;
  for (IntegerBox& box : boxes)
    for (std::size_t d = 0; d < 3; ++d) {
      cuts[d].push_back(box.min[d] -= e);
      cuts[d].push_back(box.max[d] += e);
    }
  std::array<int, 3> size;
  for (std::size_t d = 0; d < 3; ++d) {
    std::sort(cuts[d].begin(), cuts[d].end());
    cuts[d].erase(std::unique(cuts[d].begin(), cuts[d].end()), cuts[d].end());
    size[d] = 2 * static_cast<int>(cuts[d].size()) - 1;
  }
  // Corners, edges, faces and cells: even indices stand on a cut, odd ones
  // between two; what a box covers counts, its border too.
  Counted counted = {0, 0};
  std::array<int, 3> at;
  for (at[0] = 0; at[0] < size[0]; ++at[0])
    for (at[1] = 0; at[1] < size[1]; ++at[1])
      for (at[2] = 0; at[2] < size[2]; ++at[2]) {
        double volume = 1;
        int dimension = 0;
        std::array<int, 3> low, high;
        for (std::size_t d = 0; d < 3; ++d) {
          low[d] = cuts[d][static_cast<std::size_t>(at[d] / 2)];
          high[d] = cuts[d][static_cast<std::size_t>((at[d] + 1) / 2)];
          volume *= high[d] - low[d];
          dimension += at[d] % 2;
        }
        const auto covers = [&](const IntegerBox& box) {
          for (std::size_t d = 0; d < 3; ++d)
            if (low[d] < box.min[d] || high[d] > box.max[d]) return false;
          return true;
        };
        if (std::none_of(boxes.begin(), boxes.end(), covers)) continue;
        counted.volume += volume;
        counted.euler += dimension % 2 ? -1 : 1;
      }
  return counted;
}

}  // namespace phongpd::testing
