// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/windows/depth_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/stopwatch.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Facets that the first window holds, and how many times as many every further
// one: found by trying (results/lazy).
constexpr std::size_t kFirstFacets = 64;
constexpr double kWindowGrowth = 4.0;
// Of the sums' extent: where the search for the first window starts.
constexpr double kFirstShare = 0x1p-7;
// Grid steps; a smaller window holds nothing.
constexpr double kLeastReach = 64.0;
// Barycentric weights below this are rounding.
constexpr double kNoWeight = 1e-12;

// Of a facet to x along the axis where it is largest.
double AxisDistance(const WindowConvolution& part, std::size_t f,
                    const Vector3d& x) {
  const Triangle& t = part.convolution.facets[f].corners;
  Vector3d low = ToDouble(part.convolution.points[t[0]]), high = low;
  for (int k = 1; k < 3; ++k) {
    const Vector3d p = ToDouble(part.convolution.points[t[k]]);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (low - x).cwiseMax(x - high).maxCoeff();
}

WindowConvolution Restrict(const WindowConvolution& part,
                           const BoundingBox& window) {
  WindowConvolution out;
  out.convolution.points = part.convolution.points;
  for (std::size_t f = 0; f < part.origins.size(); ++f) {
    Vector3d corners[3];
    for (int k = 0; k < 3; ++k) {
      corners[k] = ToDouble(
          part.convolution.points[part.convolution.facets[f].corners[k]]);
    }
    if (IsClearlyApart(corners, window)) continue;
    out.convolution.facets.push_back(part.convolution.facets[f]);
    out.origins.push_back(part.origins[f]);
  }
  return out;
}

FeaturePoint OnVertex(int v) { return {1, {v, -1, -1}, {1.0, 0.0, 0.0}}; }

// Leaves out corners without weight.
FeaturePoint OnFacet(const GridSolid& solid, int f, const Vector3d& point) {
  const Triangle& t = solid.facets[f];
  const Vector3d n = ToDouble(solid.normals[f]);
  FeaturePoint out;
  double sum = 0.0;
  std::array<double, 3> weights;
  for (int k = 0; k < 3; ++k) {
    const Vector3d a = ToDouble(solid.vertices[t[(k + 1) % 3]]) - point;
    const Vector3d b = ToDouble(solid.vertices[t[(k + 2) % 3]]) - point;
    weights[k] = std::max(0.0, n.dot(a.cross(b)) / n.squaredNorm());
    sum += weights[k];
  }
  for (int k = 0; k < 3; ++k) {
    if (weights[k] <= kNoWeight * sum) continue;
    out.vertices[out.count] = t[k];
    out.weights[out.count] = weights[k] / sum;
    ++out.count;
  }
  return out;
}

// Chooses windows of the convolution around x by what they hold.
class WindowChooser {
 public:
  WindowChooser(const FeatureSums& sums, const Vector3d& x)
      : sums_(sums), x_(x) {
    const BoundingBox& all = sums.bounds();
    reach_ =
        std::max(kLeastReach, kFirstShare * (all.max - all.min).maxCoeff());
  }

  // The window that reaches as far as `most`.
  void Take(double most) {
    reach_ = most;
    window_ = GridWindow::Around(x_, reach_);
    part_ = sums_.Within(window_.Box());
  }

  // The largest window within `most` of x that holds about `facets` facets.
  void Choose(std::size_t facets, double most) {
    reach_ = std::min(reach_, most);
    for (;;) {
      part_ = sums_.Within(GridWindow::Around(x_, reach_).Box());
      if (part_.origins.size() >= facets || reach_ >= most) break;
      reach_ = std::min(2.0 * reach_, most);
    }
    window_ = GridWindow::Around(x_, reach_);
    if (part_.origins.size() <= facets + facets / 2) return;
    std::vector<double> distances;
    for (std::size_t f = 0; f < part_.origins.size(); ++f) {
      distances.push_back(AxisDistance(part_, f, x_));
    }
    const auto nth = distances.begin() + static_cast<std::ptrdiff_t>(facets);
    std::nth_element(distances.begin(), nth, distances.end());
    if (!(*nth > 0.0) || *nth >= reach_) return;
    reach_ = std::max(kLeastReach, *nth);
    window_ = GridWindow::Around(x_, reach_);
    part_ = Restrict(part_, window_.Box());
  }

  const GridWindow& window() const { return window_; }
  const WindowConvolution& part() const { return part_; }
  double reach() const { return reach_; }

 private:
  const FeatureSums& sums_;
  Vector3d x_;
  double reach_;
  GridWindow window_;
  WindowConvolution part_;
};

}  // namespace

DepthSearch::DepthSearch(const GridPair& pair,
                         const ContactSpaceOptions& options)
    : pair_(pair),
      judge_(pair.obstacle, pair.reflected_robot),
      sums_(pair.obstacle, pair.reflected_robot),
      gap_(pair.obstacle, pair.reflected_robot),
      build_limits_(options) {}

GridDepth DepthSearch::Find(const Vector3d& q,
                            const SearchLimits& limits) const {
  const BoundingBox& all = sums_.bounds();
  const Vector3d x = RoundedToFractions(q);
  const bool is_within = (x.array() >= all.min.array()).all() &&
                         (x.array() <= all.max.array()).all();
  if (!is_within || !judge_.Collide(x)) return Apart(x);
  GridDepth depth;
  depth.collides = true;
  SearchWindows(x, limits, &depth);
  return depth;
}

GridDepth DepthSearch::Apart(const Vector3d& x) const {
  const SolidGap::Nearest nearest = gap_.Find(x);
  GridDepth depth;
  depth.distance = nearest.distance;
  depth.point = nearest.on_p + nearest.on_q;
  depth.of_obstacle = OnFacet(pair_.obstacle, nearest.facet_of_p, nearest.on_p);
  depth.of_robot =
      OnFacet(pair_.reflected_robot, nearest.facet_of_q, nearest.on_q);
  depth.normal =
      ToDouble(pair_.obstacle.normals[nearest.facet_of_p]).normalized();
  depth.is_certified = true;
  depth.radius = depth.distance;
  return depth;
}

namespace {

// The shortest way out of a box that x is in, as a bound on the depth.
void LeaveBox(const BoundingBox& box, const Vector3d& x, GridDepth* depth) {
  depth->distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    for (const bool up : {false, true}) {
      const double way = up ? box.max[k] - x[k] : x[k] - box.min[k];
      if (way >= depth->distance) continue;
      depth->distance = way;
      depth->normal = (up ? 1.0 : -1.0) * Vector3d::Unit(k);
      depth->point = x + way * depth->normal;
    }
  }
}

}  // namespace

void DepthSearch::SearchWindows(const Vector3d& x, const SearchLimits& limits,
                                GridDepth* depth) const {
  const Stopwatch stopwatch;
  // What it may take is known from query to query, cancelled is this one alone.
  BuildLimits build_limits(build_limits_);
  build_limits.ObserveCancellation();
  // Beyond the box of all sums everything is free.
  const BoundingBox& all = sums_.bounds();
  LeaveBox(all, x, depth);
  WindowChooser chooser(sums_, x);
  std::size_t facets = kFirstFacets;
  bool is_found = false;
  for (;;) {
    const double most = std::min(depth->distance, limits.max_radius);
    build_limits.Check("windows");
    // A point that is known says how far to look.
    is_found ? chooser.Take(most) : chooser.Choose(facets, most);
    const GridWindow& window = chooser.window();
    const WindowConvolution& part = chooser.part();
    depth->radius = window.WallDistance(x);
    if (!part.origins.empty()) {
      WindowCells cells(part, window, judge_, build_limits);
      ++depth->windows;
      depth->reaches.push_back(chooser.reach());
      depth->faces += static_cast<std::size_t>(cells.FaceCount());
      const WindowCells::Nearest nearest = cells.FindNearest(x);
      if (nearest.found && (!is_found || nearest.distance < depth->distance)) {
        is_found = true;
        depth->distance = nearest.distance;
        depth->point = nearest.point;
        depth->normal = nearest.normal;
        TellFeatures(part, nearest.facet, depth);
      }
    }
    depth->is_certified = is_found && depth->distance <= depth->radius;
    const BoundingBox box = window.Box();
    depth->is_full = (box.min.array() < all.min.array()).all() &&
                     (box.max.array() > all.max.array()).all();
    // Where everything beyond is free, a window that shows no free cell can
    // only be rounding's fault: a bound is all there is.
    if (depth->is_certified || depth->is_full ||
        (!is_found && chooser.reach() >= depth->distance) ||
        depth->radius >= limits.max_radius ||
        (limits.max_seconds > 0.0 &&
         stopwatch.Seconds() > limits.max_seconds)) {
      build_limits_.LearnFrom(build_limits);
      return;
    }
    facets = static_cast<std::size_t>(
        kWindowGrowth *
        static_cast<double>(std::max(facets, part.origins.size())));
  }
}

void DepthSearch::TellFeatures(const WindowConvolution& part, int facet,
                               GridDepth* depth) const {
  const GridSolid& p = pair_.obstacle;
  const GridSolid& q = pair_.reflected_robot;
  const SumOrigin& origin = part.origins[facet];
  switch (part.convolution.facets[facet].kind) {
    case ContactKind::kObstacleFacet:
      depth->of_robot = OnVertex(origin.of_q);
      depth->of_obstacle = OnFacet(
          p, origin.of_p, depth->point - ToDouble(q.vertices[origin.of_q]));
      break;
    case ContactKind::kRobotFacet:
      depth->of_obstacle = OnVertex(origin.of_p);
      depth->of_robot = OnFacet(
          q, origin.of_q, depth->point - ToDouble(p.vertices[origin.of_p]));
      break;
    case ContactKind::kEdges: {
      const ConvexEdge& e = sums_.EdgeOfP(origin.of_p);
      const ConvexEdge& g = sums_.EdgeOfQ(origin.of_q);
      // point = a + s·e + b + t·g.
      const Vector3d n = e.rounded[0].cross(g.rounded[0]);
      const Vector3d w =
          depth->point - ToDouble(p.vertices[e.a]) - ToDouble(q.vertices[g.a]);
      const double s =
          std::clamp(w.cross(g.rounded[0]).dot(n) / n.squaredNorm(), 0.0, 1.0);
      const double t =
          std::clamp(e.rounded[0].cross(w).dot(n) / n.squaredNorm(), 0.0, 1.0);
      depth->of_obstacle = {2, {e.a, e.b, -1}, {1.0 - s, s, 0.0}};
      depth->of_robot = {2, {g.a, g.b, -1}, {1.0 - t, t, 0.0}};
      break;
    }
    case ContactKind::kNone:  // walls have no origin and answer nothing
      break;
  }
}

}  // namespace phongpd::internal
