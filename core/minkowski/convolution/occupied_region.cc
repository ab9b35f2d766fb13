// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/occupied_region.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/bvh/segment_reach.h"
#include "core/minkowski/convolution/window_convolution.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// A box with fewer facets is not worth splitting.
constexpr std::size_t kFewFacets = 10;
constexpr int kMaxDepth = 7;

BoundingBox ChildOf(const BoundingBox& box, int child) {
  const Vector3d center = box.Center();
  BoundingBox out = box;
  for (int k = 0; k < 3; ++k) {
    ((child >> k & 1) != 0 ? out.min : out.max)[k] = center[k];
  }
  return out;
}

}  // namespace

struct OccupiedRegion::Builder {
  using Sample = OccupiedBalls::Sample;

  void Corners(int facet, Vector3d corners[3]) const {
    for (int k = 0; k < 3; ++k) {
      corners[k] =
          ToDouble(convolution.points[convolution.facets[facet].corners[k]]);
    }
  }

  // `samples` by overlap, most first, as known at `seen`.
  void Build(const BoundingBox& box, const std::vector<int>& facets,
             std::vector<Sample> samples, const Vector3d& seen, int depth,
             Node* node) const {
    limits.CheckNow("culling");
    const Vector3d center = box.Center();
    const double radius = 0.5 * box.Diagonal() + balls.margin();
    const double moved = (center - seen).norm();
    for (Sample& s : samples) {
      s.overlap += moved;
      if (s.overlap <= radius || !balls.Overlaps(center, radius, &s)) {
        continue;
      }
      node->is_occupied = true;
      return;
    }
    if (depth == kMaxDepth) return;
    samples.erase(std::remove_if(samples.begin(), samples.end(),
                                 [radius](const Sample& s) {
                                   return s.overlap < -radius;
                                 }),
                  samples.end());
    if (samples.empty()) return;
    std::stable_sort(
        samples.begin(), samples.end(),
        [](const Sample& a, const Sample& b) { return a.overlap > b.overlap; });
    node->children = std::make_unique<std::array<Node, 8>>();
    tbb::parallel_for(0, 8, [&](int child) {
      const BoundingBox part = ChildOf(box, child);
      std::vector<int> inside;
      for (const int f : facets) {
        Vector3d corners[3];
        Corners(f, corners);
        if (!IsClearlyApart(corners, part)) inside.push_back(f);
      }
      if (inside.size() < kFewFacets) return;
      Build(part, inside, samples, center, depth + 1,
            &(*node->children)[child]);
    });
  }

  const OccupiedBalls& balls;
  const Convolution& convolution;
  const BuildLimits& limits;
};

OccupiedRegion::OccupiedRegion(const GridSolid& p, const GridSolid& q,
                               const Convolution& convolution,
                               const BuildLimits& limits) {
  const OccupiedBalls balls(p, q, OccupiedBalls::Asked::kOften);
  Vector3d corners[3];
  const Builder builder{balls, convolution, limits};
  for (std::size_t f = 0; f < convolution.facets.size(); ++f) {
    builder.Corners(static_cast<int>(f), corners);
    for (int k = 0; k < 3; ++k) {
      if (f == 0 && k == 0) bounds_ = {corners[0], corners[0]};
      bounds_.min = bounds_.min.cwiseMin(corners[k]);
      bounds_.max = bounds_.max.cwiseMax(corners[k]);
    }
  }
  Build(builder);
}

OccupiedRegion::OccupiedRegion(const OccupiedBalls& balls,
                               const BoundingBox& box,
                               const Convolution& convolution,
                               const BuildLimits& limits)
    : bounds_(box) {
  Build({balls, convolution, limits});
}

void OccupiedRegion::Build(const Builder& builder) {
  std::vector<int> facets(builder.convolution.facets.size());
  std::iota(facets.begin(), facets.end(), 0);
  root_ = std::make_unique<Node>();
  builder.Build(bounds_, facets, builder.balls.Samples(), bounds_.Center(), 0,
                root_.get());
}

template <typename Meets>
bool OccupiedRegion::ContainsPart(const Node& node, const BoundingBox& box,
                                  const Meets& meets) {
  if (node.is_occupied || !meets(box)) return true;
  if (node.children == nullptr) return false;
  for (int child = 0; child < 8; ++child) {
    if (!ContainsPart((*node.children)[child], ChildOf(box, child), meets)) {
      return false;
    }
  }
  return true;
}

bool OccupiedRegion::Contains(const BoundingBox& box) const {
  const auto meets = [&box](const BoundingBox& node) {
    return (node.min.array() <= box.max.array()).all() &&
           (node.max.array() >= box.min.array()).all();
  };
  return root_ != nullptr && ContainsPart(*root_, bounds_, meets) &&
         (box.min.array() >= bounds_.min.array()).all() &&
         (box.max.array() <= bounds_.max.array()).all();
}

bool OccupiedRegion::Contains(const Vector3d& a, const Vector3d& b) const {
  if (root_ == nullptr) return false;
  const double largest = std::max(bounds_.min.cwiseAbs().maxCoeff(),
                                  bounds_.max.cwiseAbs().maxCoeff());
  const SegmentReach segment(a, b, largest);
  const auto meets = [&segment](const BoundingBox& node) {
    return segment.Meets({node.min, node.max});
  };
  return ContainsPart(*root_, bounds_, meets);
}

bool OccupiedRegion::Contains(const Vector3d corners[3]) const {
  const auto meets = [corners](const BoundingBox& node) {
    return !IsClearlyApart(corners, node);
  };
  return root_ != nullptr && ContainsPart(*root_, bounds_, meets);
}

}  // namespace phongpd::internal
