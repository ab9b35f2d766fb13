// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/occupied_region.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/bvh/segment_reach.h"
#include "core/bvh/triangle_bvh.h"
#include "core/mesh/union_find.h"
#include "core/minkowski/convolution/window_convolution.h"
#include "core/minkowski/operands/coarse_depth.h"
#include "core/minkowski/operands/inner_balls.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Balls in each operand that are tried; corners, and edges.
constexpr std::size_t kBalls = 64;
constexpr std::size_t kPoints = 32;
// A box with fewer facets is not worth splitting.
constexpr std::size_t kFewFacets = 10;
constexpr int kMaxDepth = 7;
// Boxes are taken larger by this: far above all rounding, of the distances and
// of the points that are asked about.
constexpr double kMarginSteps = 0x1p-4;
constexpr double kMarginShare = 1e-9;

BoundingBox ChildOf(const BoundingBox& box, int child) {
  const Vector3d center = box.Center();
  BoundingBox out = box;
  for (int k = 0; k < 3; ++k) {
    ((child >> k & 1) != 0 ? out.min : out.max)[k] = center[k];
  }
  return out;
}

// Does a component face inwards, or enclose nothing?  Such a one may lie where
// the solid is not, and so may its surface.
bool HasCavity(const GridSolid& solid) {
  UnionFind sets(solid.vertices.size());
  for (const Triangle& t : solid.facets) {
    sets.Join(t[0], t[1]);
    sets.Join(t[0], t[2]);
  }
  std::map<int, double> volumes;
  for (const Triangle& t : solid.facets) {
    const int component = sets.Find(t[0]);
    const Vector3d origin = ToDouble(solid.vertices[component]);
    const Vector3d a = ToDouble(solid.vertices[t[0]]) - origin;
    const Vector3d b = ToDouble(solid.vertices[t[1]]) - origin;
    const Vector3d c = ToDouble(solid.vertices[t[2]]) - origin;
    volumes[component] += a.dot(b.cross(c));
  }
  return std::any_of(volumes.begin(), volumes.end(),
                     [](const auto& v) { return !(v.second > 0.0); });
}

// Corners and edges' middles, an even choice of each: what balls do not reach.
void AddSurfacePoints(const GridSolid& solid, std::vector<InnerBall>* out) {
  const auto at = [&](int v) { return ToDouble(solid.vertices[v]); };
  std::vector<Vector3d> corners, edges;
  for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
    if (!solid.neighbors[v].empty()) corners.push_back(at(static_cast<int>(v)));
  }
  for (const GridEdge& e : solid.edges) {
    edges.push_back(0.5 * (at(e.a) + at(e.b)));
  }
  for (const std::vector<Vector3d>* points : {&corners, &edges}) {
    const std::size_t most = std::min(points->size(), kPoints);
    for (std::size_t i = 0; i < most; ++i) {
      out->push_back({(*points)[i * points->size() / most], 0.0});
    }
  }
}

// One of the balls moved to a solid, and how far it reaches into that at the
// most (its radius and the depth of its center); < 0: apart.
struct Sample {
  double overlap;
  int solid, ball;
  int near = -1;  // position of a triangle that was the closest nearby
};

}  // namespace

struct OccupiedRegion::Builder {
  Builder(const GridSolid& p, const GridSolid& q,
          const Convolution& the_convolution, const BuildLimits& the_limits)
      : convolution(the_convolution),
        limits(the_limits),
        solids{BvhOf(p), BvhOf(q)},
        holds_surface{!HasCavity(p), !HasCavity(q)},
        depths{CoarseDepth(solids[0]), CoarseDepth(solids[1])} {
    balls[0] = InnerBalls(q, solids[1], kBalls);
    balls[1] = InnerBalls(p, solids[0], kBalls);
    if (holds_surface[1]) AddSurfacePoints(q, &balls[0]);
    if (holds_surface[0]) AddSurfacePoints(p, &balls[1]);
  }

  // Sets what the ball overlaps by with the box's center as configuration, or
  // a bound of it that tells whether it is above `wanted`, and tells.
  bool Overlaps(const Vector3d& center, double wanted, Sample* s) const {
    const InnerBall& ball = balls[s->solid][s->ball];
    const bool is_held = holds_surface[s->solid];
    const Vector3d x = center - ball.center;
    const CoarseDepth::Bounds depth = depths[s->solid].At(x);
    s->overlap = std::min(s->overlap, ball.radius + depth.most);
    if (ball.radius + depth.least > wanted && (is_held || depth.least > 0.0)) {
      return true;
    }
    if (s->overlap <= wanted) return false;
    const TriangleBvh& solid = solids[s->solid];
    const double distance = SurfaceDistance(solid, x, &s->near);
    // Where the surface is far or near enough it need not be known on which
    // side x is.
    if (is_held && ball.radius - distance > wanted) return true;
    s->overlap = std::min(s->overlap, ball.radius + distance);
    if (s->overlap <= wanted) return false;
    if (solid.WindingNumber(x) > 0) return true;
    s->overlap = ball.radius - distance;
    return false;
  }

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
    limits.Look("culling");
    const Vector3d center = box.Center();
    const double radius = 0.5 * box.Diagonal() + margin;
    const double moved = (center - seen).norm();
    for (Sample& s : samples) {
      s.overlap += moved;
      if (s.overlap <= radius || !Overlaps(center, radius, &s)) continue;
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

  const Convolution& convolution;
  const BuildLimits& limits;
  std::array<TriangleBvh, 2> solids;
  std::array<bool, 2> holds_surface;  // surely is all of its surface in it
  std::array<CoarseDepth, 2> depths;  // in them
  std::array<std::vector<InnerBall>, 2> balls;  // to move into each solid
  double margin = 0.0;
};

OccupiedRegion::OccupiedRegion(const GridSolid& p, const GridSolid& q,
                               const Convolution& convolution,
                               const BuildLimits& limits) {
  std::vector<int> facets;
  Builder builder(p, q, convolution, limits);
  for (std::size_t f = 0; f < convolution.facets.size(); ++f) {
    Vector3d corners[3];
    builder.Corners(static_cast<int>(f), corners);
    for (int k = 0; k < 3; ++k) {
      if (f == 0 && k == 0) bounds_ = {corners[0], corners[0]};
      bounds_.min = bounds_.min.cwiseMin(corners[k]);
      bounds_.max = bounds_.max.cwiseMax(corners[k]);
    }
    facets.push_back(static_cast<int>(f));
  }
  builder.margin = std::max(kMarginSteps, kMarginShare * bounds_.Diagonal());
  std::vector<Sample> samples;
  for (int solid = 0; solid < 2; ++solid) {
    for (std::size_t i = 0; i < builder.balls[solid].size(); ++i) {
      samples.push_back({std::numeric_limits<double>::infinity(), solid,
                         static_cast<int>(i)});
    }
  }
  root_ = std::make_unique<Node>();
  builder.Build(bounds_, facets, std::move(samples), bounds_.Center(), 0,
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
