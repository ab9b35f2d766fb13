// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/canonical_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/minkowski/operands/exact_grid.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Unit normals closer than this are one direction: far above the rounding of
// a turned facet, far below the angle between facets that differ on purpose.
constexpr double kSameDirection = 1e-10;
// Directions with less area do not decide a frame.  Shares of both operands
// add up, to 2 at most.
constexpr double kLeastShare = 0.01;
// Gain in axis-aligned share below which turning is not worth its rounding:
// one facet in ten of one operand.  (A star on a torus gains 0.03 and gets 5 %
// more triangles, all of them slivers.)
constexpr double kLeastGain = 0.1;

// Facets far from each other never are one direction: what is closer than this
// is looked at together.
constexpr double kNearby = 1e-8;

// Both operands' facets: direction, opposite normals taken together, and share
// of the operand's area.
class Facets {
 public:
  Facets(const TriangleMesh& robot, const TriangleMesh& obstacle)
      : operands_{Operand(robot), Operand(obstacle)} {}

  // visit(unit normal, its sign fixed; share), in the meshes' order.
  template <typename Visit>
  void ForEach(const Visit& visit) const {
    for (const Operand& operand : operands_) {
      if (!(operand.total > 0.0)) continue;
      const double scale = operand.scale;
      for (const Triangle& t : operand.mesh->triangles) {
        const Vector3d& a = operand.mesh->vertices[t[0]];
        Vector3d n = (scale * (operand.mesh->vertices[t[1]] - a))
                         .cross(scale * (operand.mesh->vertices[t[2]] - a));
        const double area = 0.5 * n.norm();
        if (!(area > 0)) continue;
        n /= 2 * area;
        if (n[LargestAxis(n)] < 0) n = -n;
        visit(n, area / operand.total);
      }
    }
  }

 private:
  struct Operand {
    explicit Operand(const TriangleMesh& the_mesh)
        : mesh(&the_mesh), total(SurfaceArea(the_mesh)) {
      if (!(total > 0.0)) return;
      // In units of about its root: squares of areas leave the range of doubles
      // from lengths of 1e±77 on.
      int exponent = 0;
      std::frexp(std::sqrt(total), &exponent);
      scale = std::ldexp(1.0, -exponent);
      total *= scale * scale;
    }
    const TriangleMesh* mesh;
    double total, scale = 1.0;
  };
  Operand operands_[2];
};

// Calls visit(cell) for each cell of edge 1 / `cells` within `reach` of n.
template <typename Visit>
void ForEachCell(const Vector3d& n, double reach, double cells,
                 const Visit& visit) {
  GridPoint low, high;
  for (int k = 0; k < 3; ++k) {
    low[k] = std::llround(std::floor((n[k] - reach) * cells));
    high[k] = std::llround(std::floor((n[k] + reach) * cells));
  }
  for (std::int64_t x = low[0]; x <= high[0]; ++x) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t z = low[2]; z <= high[2]; ++z) visit({x, y, z});
    }
  }
}

// No direction has more than the share that is told here, which other ones may
// be counted in (a count-min sketch): of a million facets, few of which have
// their direction in common, the many are left out by looking at a table that
// stays in the cache.
class ShareBounds {
 public:
  ShareBounds() : sums_(kSlots, 0.0) {}
  void Add(const Vector3d& n, double share) {
    ForEachSum(n, [share](double& sum) { sum += share; });
  }
  // Could its direction have so much?
  bool Reaches(const Vector3d& n, double share) {
    bool reaches = false;
    ForEachSum(n, [&](double sum) { reaches = reaches || sum > share; });
    return reaches;
  }

 private:
  template <typename Visit>
  void ForEachSum(const Vector3d& n, const Visit& visit) {
    ForEachCell(n, kNearby, kCells, [&](const GridPoint& cell) {
      visit(sums_[GridPointHash()(cell) % kSlots]);
    });
  }
  static constexpr double kCells = 1e4;
  static constexpr std::size_t kSlots = 1 << 16;
  std::vector<double> sums_;
};

struct Direction {
  Vector3d sum;  // Σ share · normal
  double share;
};

// Area shares by direction.
class DirectionTable {
 public:
  void Add(const Vector3d& n, double share) {
    Direction* same = Find(n);
    if (same != nullptr) {
      same->sum += share * n;
      same->share += share;
      return;
    }
    GridPoint home;
    for (int k = 0; k < 3; ++k) {
      home[k] = std::llround(std::floor(n[k] * kCells));
    }
    cells_.emplace(home, static_cast<int>(directions_.size()));
    directions_.push_back({share * n, share});
  }

  // Largest share first.
  std::vector<Direction> Sorted() const {
    std::vector<Direction> sorted = directions_;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Direction& a, const Direction& b) {
                       return a.share > b.share;
                     });
    return sorted;
  }

 private:
  Direction* Find(const Vector3d& n) {
    Direction* found = nullptr;
    ForEachCell(n, kSameDirection, kCells, [&](const GridPoint& cell) {
      if (found != nullptr) return;
      const auto range = cells_.equal_range(cell);
      for (auto it = range.first; it != range.second; ++it) {
        Direction& d = directions_[it->second];
        if ((d.sum / d.share - n).norm() > kSameDirection) continue;
        found = &d;
        return;
      }
    });
    return found;
  }

  static constexpr double kCells = 1e6;  // hash cells per unit
  std::unordered_multimap<GridPoint, int, GridPointHash> cells_;
  std::vector<Direction> directions_;
};

// Those that may have kLeastShare, largest first.
std::vector<Direction> LargeDirections(const Facets& facets) {
  ShareBounds bounds;
  facets.ForEach(
      [&](const Vector3d& n, double share) { bounds.Add(n, share); });
  DirectionTable table;
  facets.ForEach([&](const Vector3d& n, double share) {
    // Sums of many shares are rounded.
    if (bounds.Reaches(n, 0.99 * kLeastShare)) table.Add(n, share);
  });
  return table.Sorted();
}

double OffAxis(const Vector3d& n) {
  return n.lpNorm<1>() - n.lpNorm<Eigen::Infinity>();
}

// Share of the area whose normals lie along the rows of `rotation`.
double AlignedShare(const Facets& facets, const Eigen::Matrix3d& rotation) {
  DirectionTable table;
  facets.ForEach([&](const Vector3d& n, double share) {
    if (OffAxis(rotation * n) < kNearby) table.Add(n, share);
  });
  double share = 0.0;
  for (const Direction& d : table.Sorted()) {
    const Vector3d n = rotation * d.sum.normalized();
    if (OffAxis(n) < kSameDirection) share += d.share;
  }
  return share;
}

}  // namespace

CanonicalFrame ChooseCanonicalFrame(const TriangleMesh& robot,
                                    const TriangleMesh& obstacle) {
  CanonicalFrame frame;
  const Facets facets(robot, obstacle);
  const std::vector<Direction> directions = LargeDirections(facets);
  if (directions.empty() || directions[0].share < kLeastGain) return frame;
  const Vector3d z = directions[0].sum.normalized();
  Vector3d x = Vector3d::Zero();
  for (const Direction& d : directions) {
    if (d.share < kLeastShare) break;
    if (std::abs(d.sum.normalized().dot(z)) < kSameDirection) {
      x = d.sum.normalized();
      break;
    }
  }
  // One direction alone (a plate, an extrusion): any axis across it will do.
  if (x.isZero(0.0)) x = z.unitOrthogonal();
  x = (x - x.dot(z) * z).normalized();
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
  const double before = AlignedShare(facets, Eigen::Matrix3d::Identity());
  if (AlignedShare(facets, rotation) < before + kLeastGain) return frame;
  frame.rotation = rotation;
  frame.used = true;
  return frame;
}

}  // namespace phongpd::internal
