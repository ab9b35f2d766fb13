// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/occupied_balls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>

#include "core/mesh/union_find.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Balls in each operand that are tried; corners, and edges.
constexpr std::size_t kBalls = 64;
constexpr std::size_t kPoints = 32;
// Of each operand where few are to be tried.
constexpr std::size_t kFewBalls = 12;
// Solids may be deeper than their largest ball that was found, by this factor
// at most, or something is not left out.
constexpr double kDeepest = 1.5;
// Balls are taken larger by this: far above all rounding, of the distances and
// of the points that are asked about.
constexpr double kMarginSteps = 0x1p-4;
constexpr double kMarginShare = 1e-9;

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

BoundingBox BoundsOf(const TriangleBvh& bvh) {
  return {bvh.tree().nodes()[0].min, bvh.tree().nodes()[0].max};
}

}  // namespace

OccupiedBalls::OccupiedBalls(const GridSolid& p, const GridSolid& q,
                             Asked asked)
    : solids_{BvhOf(p), BvhOf(q)},
      holds_surface_{!HasCavity(p), !HasCavity(q)} {
  const bool is_often = asked == Asked::kOften;
  const std::size_t most = is_often ? kBalls : kFewBalls;
  balls_[0] = InnerBalls(q, solids_[1], most);
  balls_[1] = InnerBalls(p, solids_[0], most);
  if (is_often) {
    if (holds_surface_[1]) AddSurfacePoints(q, &balls_[0]);
    if (holds_surface_[0]) AddSurfacePoints(p, &balls_[1]);
    depths_ = {CoarseDepth(solids_[0]), CoarseDepth(solids_[1])};
  }
  const BoundingBox a = BoundsOf(solids_[0]), b = BoundsOf(solids_[1]);
  const double diagonal = BoundingBox{a.min + b.min, a.max + b.max}.Diagonal();
  margin_ = std::max(kMarginSteps, kMarginShare * diagonal);
}

std::vector<OccupiedBalls::Sample> OccupiedBalls::Samples() const {
  std::vector<Sample> samples;
  for (int solid = 0; solid < 2; ++solid) {
    for (std::size_t i = 0; i < balls_[solid].size(); ++i) {
      samples.push_back({std::numeric_limits<double>::infinity(), solid,
                         static_cast<int>(i)});
    }
  }
  return samples;
}

bool OccupiedBalls::Overlaps(const Vector3d& center, double wanted,
                             Sample* s) const {
  const InnerBall& ball = balls_[s->solid][s->ball];
  const bool is_held = holds_surface_[s->solid];
  const Vector3d x = center - ball.center;
  if (!depths_.empty()) {
    const CoarseDepth::Bounds depth = depths_[s->solid].At(x);
    s->overlap = std::min(s->overlap, ball.radius + depth.most);
    if (ball.radius + depth.least > wanted && (is_held || depth.least > 0.0)) {
      return true;
    }
    if (s->overlap <= wanted) return false;
  }
  const TriangleBvh& solid = solids_[s->solid];
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

bool OccupiedBalls::Contain(const Vector3d& center, double radius,
                            int* last) const {
  const double wanted = radius + margin_;
  const int first = static_cast<int>(balls_[0].size());
  const int count = first + static_cast<int>(balls_[1].size());
  for (int i = 0; i < count; ++i) {
    const int k = (*last + i) % count;
    Sample sample{std::numeric_limits<double>::infinity(), k < first ? 0 : 1,
                  k < first ? k : k - first};
    // The largest ball is about as large as the solid is deep.
    const std::vector<InnerBall>& own = balls_[1 - sample.solid];
    const double depth = own.empty() ? 0.0 : kDeepest * own[0].radius;
    if (balls_[sample.solid][sample.ball].radius + depth <= wanted) continue;
    if (!Overlaps(center, wanted, &sample)) continue;
    *last = k;
    return true;
  }
  return false;
}

}  // namespace phongpd::internal
