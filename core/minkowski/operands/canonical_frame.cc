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

struct Direction {
  Vector3d sum;  // Σ share · normal, the sign fixed
  double share;
};

// Area shares by facet direction, opposite normals taken together.
class DirectionTable {
 public:
  void Add(const TriangleMesh& mesh) {
    double total = SurfaceArea(mesh);
    if (!(total > 0.0)) return;
    // In units of about its root: squares of areas leave the range of doubles
    // from lengths of 1e±77 on.
    int exponent = 0;
    std::frexp(std::sqrt(total), &exponent);
    const double scale = std::ldexp(1.0, -exponent);
    total *= scale * scale;
    for (const Triangle& t : mesh.triangles) {
      const Vector3d& a = mesh.vertices[t[0]];
      Vector3d n = (scale * (mesh.vertices[t[1]] - a))
                       .cross(scale * (mesh.vertices[t[2]] - a));
      const double area = 0.5 * n.norm();
      if (!(area > 0)) continue;
      n /= 2 * area;
      if (n[LargestAxis(n)] < 0) n = -n;
      Find(n, area / total);
    }
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
  void Find(const Vector3d& n, double share) {
    GridPoint low, high;
    for (int k = 0; k < 3; ++k) {
      low[k] = std::llround(std::floor((n[k] - kSameDirection) * kCells));
      high[k] = std::llround(std::floor((n[k] + kSameDirection) * kCells));
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto range = cells_.equal_range({x, y, z});
          for (auto it = range.first; it != range.second; ++it) {
            Direction& d = directions_[it->second];
            if ((d.sum / d.share - n).norm() > kSameDirection) continue;
            d.sum += share * n;
            d.share += share;
            return;
          }
        }
      }
    }
    GridPoint home;
    for (int k = 0; k < 3; ++k) {
      home[k] = std::llround(std::floor(n[k] * kCells));
    }
    cells_.emplace(home, static_cast<int>(directions_.size()));
    directions_.push_back({share * n, share});
  }

  static constexpr double kCells = 1e6;  // hash cells per unit
  std::unordered_multimap<GridPoint, int, GridPointHash> cells_;
  std::vector<Direction> directions_;
};

// Share of the area whose normals lie along the rows of `rotation`.
double AlignedShare(const std::vector<Direction>& directions,
                    const Eigen::Matrix3d& rotation) {
  double share = 0.0;
  for (const Direction& d : directions) {
    const Vector3d n = rotation * d.sum.normalized();
    const double off_axis = n.lpNorm<1>() - n.lpNorm<Eigen::Infinity>();
    if (off_axis < kSameDirection) share += d.share;
  }
  return share;
}

}  // namespace

CanonicalFrame ChooseCanonicalFrame(const TriangleMesh& robot,
                                    const TriangleMesh& obstacle) {
  CanonicalFrame frame;
  DirectionTable table;
  table.Add(robot);
  table.Add(obstacle);
  const std::vector<Direction> directions = table.Sorted();
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
  const double before = AlignedShare(directions, Eigen::Matrix3d::Identity());
  if (AlignedShare(directions, rotation) < before + kLeastGain) return frame;
  frame.rotation = rotation;
  frame.used = true;
  return frame;
}

}  // namespace phongpd::internal
