// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bounds/distance_search.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>

#include "core/solid/shell_orientation.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr double kDistanceRounding = 1e-14;  // of the diagonal

void PlanLongestCut(Piece* piece) {
  double longest = -1.0;
  for (int i = 0; i < piece->count; ++i) {
    for (int j = i + 1; j < piece->count; ++j) {
      const double length =
          (piece->corners[i] - piece->corners[j]).squaredNorm();
      if (length <= longest) continue;
      longest = length;
      piece->cut_a = i;
      piece->cut_b = j;
    }
  }
  piece->cut_at = 0.5;
}

// Plans to cut the part of the piece that hangs over an edge of triangle
// a, b, c off, seen from its farthest corner: what is left is as close as it
// looks.  Returns false where that makes no sense.
bool PlanOverhangCut(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                     int farthest, Piece* piece) {
  constexpr double kLeast = 0.02;  // of the edge, cut off
  const Vector3d normal = (b - a).cross(c - a);
  const std::array<const Vector3d*, 4> ring = {&a, &b, &c, &a};
  double best = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d outward = (*ring[k + 1] - *ring[k]).cross(normal);
    const double length = outward.norm();
    if (!(length > 0.0)) continue;
    const auto overhang = [&](int i) {
      return (piece->corners[i] - *ring[k]).dot(outward) / length;
    };
    const double out = overhang(farthest);
    if (out <= best) continue;
    int deepest = farthest;
    for (int i = 0; i < piece->count; ++i) {
      if (overhang(i) < overhang(deepest)) deepest = i;
    }
    const double in = overhang(deepest);
    if (in >= 0.0) continue;
    const double at = in / (in - out);
    if (at < kLeast || at > 1.0 - kLeast) continue;
    best = out;
    piece->cut_a = deepest;
    piece->cut_b = farthest;
    piece->cut_at = at;
  }
  return best > 0.0;
}

std::array<Piece, 2> Cut(const Piece& piece) {
  const Vector3d& a = piece.corners[piece.cut_a];
  const Vector3d& b = piece.corners[piece.cut_b];
  const Vector3d middle = a + piece.cut_at * (b - a);
  std::array<Piece, 2> halves = {piece, piece};
  halves[0].corners[piece.cut_a] = middle;
  halves[1].corners[piece.cut_b] = middle;
  return halves;
}

struct Ball {
  Vector3d center;
  double radius;
};

Ball BallAround(const Piece& piece) {
  Ball ball = {Vector3d::Zero(), 0.0};
  for (int k = 0; k < piece.count; ++k) ball.center += piece.corners[k];
  ball.center /= piece.count;
  for (int k = 0; k < piece.count; ++k) {
    ball.radius =
        std::max(ball.radius, (piece.corners[k] - ball.center).norm());
  }
  return ball;
}

// Lowers piece->upper as far as one look can, plans its cut, and returns a
// distance that is reached by a point that counts.  With an upper bound of
// `enough` or less the piece is of no interest and nothing is said about what
// it reaches.
double Examine(const DistanceTarget& target, const DistanceTarget* domain,
               double enough, Piece* piece) {
  const auto& [center, radius] = BallAround(*piece);
  int closest = 0;
  const double distance = target.At(center, &closest);
  const double lipschitz = std::max(0.0, distance + radius);
  piece->upper = std::min(piece->upper, lipschitz);
  if (piece->upper <= enough) return 0.0;
  PlanLongestCut(piece);
  if (domain != nullptr) {
    int unused = 0;
    const double outside = domain->At(center, &unused);
    if (outside > radius ||
        target.FacesOneWay(center, std::max(0.0, distance) + 2.0 * radius)) {
      piece->upper = 0.0;
    }
    return outside > 0.0 ? 0.0 : std::max(0.0, distance);
  }
  const auto& [a, b, c] = target.Corners(closest);
  double convex = 0.0;
  int farthest = 0;
  for (int v = 0; v < piece->count; ++v) {
    const double squared =
        ClosestOnTriangle(a, b, c, piece->corners[v]).squared_distance;
    if (std::sqrt(squared) <= convex) continue;
    convex = std::sqrt(squared);
    farthest = v;
  }
  piece->upper = std::min(piece->upper, convex);
  if (piece->upper <= enough) return 0.0;
  // Cuts along edges of the target converge fast where it pays, halves
  // always: by turns.
  const bool is_cut_along_edge =
      piece->was_cut_in_half && PlanOverhangCut(a, b, c, farthest, piece);
  piece->was_cut_in_half = !is_cut_along_edge;
  const double tip = target.At(piece->corners[farthest], &closest);
  return std::max({0.0, distance, tip});
}

}  // namespace

DistanceTarget::DistanceTarget(TriangleMesh mesh, bool is_solid)
    : mesh_(std::move(mesh)), tree_(mesh_) {
  std::vector<BoundingBox> boxes;
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& [a, b, c] = Corners(static_cast<int>(t));
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
    const Vector3d e = b - a, f = c - a, n = e.cross(f);
    const double size = std::max(e.squaredNorm(), f.squaredNorm());
    const bool is_proper = n.norm() > 1e-10 * size;
    normals_.push_back(is_proper ? n.normalized() : Vector3d::Zero());
  }
  boxes_ = BoxTree(boxes, 2);
  if (!is_solid) return;
  int count = 0;
  const std::vector<int> labels = LabelShells(mesh_, &count);
  std::vector<std::vector<Triangle>> shells(count);
  for (std::size_t t = 0; t < labels.size(); ++t) {
    shells[labels[t]].push_back(mesh_.triangles[t]);
  }
  TriangleMesh shell;
  shell.vertices = mesh_.vertices;
  for (std::vector<Triangle>& triangles : shells) {
    shell.triangles = std::move(triangles);
    sign_.push_back(SignedVolume(shell) > 0.0 ? 1 : -1);
    inside_.emplace_back(shell);
  }
}

std::array<Vector3d, 3> DistanceTarget::Corners(int triangle) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
}

double DistanceTarget::At(const Vector3d& x, int* closest) const {
  const TriangleBvh::Closest found = tree_.FindClosest(x);
  *closest = found.triangle;
  return Contains(x) ? -found.distance : found.distance;
}

bool DistanceTarget::Contains(const Vector3d& x) const {
  int winding = 0;
  for (std::size_t i = 0; i < inside_.size(); ++i) {
    if (inside_[i].Locate(x) == Location::kInside) winding += sign_[i];
  }
  return winding > 0;
}

bool DistanceTarget::FacesOneWay(const Vector3d& center, double radius) const {
  constexpr double kClearly = 1e-6;
  const double squared = radius * radius;
  Vector3d first = Vector3d::Zero(), sum = Vector3d::Zero();
  const auto is_near = [&](int node) {
    return boxes_.nodes()[node].SquaredDistance(center) <= squared;
  };
  bool is_one_way = true;
  const auto check = [&](const Vector3d& against, double least) {
    boxes_.ForEach(is_near, [&](int position) {
      const int item = boxes_.order()[position];
      const auto& [a, b, c] = Corners(item);
      if (ClosestOnTriangle(a, b, c, center).squared_distance > squared) {
        return true;
      }
      const Vector3d& n = normals_[item];
      if (first.isZero()) first = n;
      sum += n;
      // Of two opposite normals no third can see both.
      is_one_way = !n.isZero() && n.dot(against) > least &&
                   n.dot(first) > -1.0 + kClearly;
      return is_one_way;
    });
  };
  check(Vector3d::Zero(), -1.0);
  if (!is_one_way) return false;
  check(sum.normalized(), kClearly);
  return is_one_way;
}

DistanceBounds FarthestPoint(std::vector<Piece> pieces,
                             const DistanceTarget& target,
                             const DistanceTarget* domain,
                             const DistanceSearch& search, double diagonal,
                             double reached) {
  constexpr std::size_t kBatch = 64;  // looked at in parallel
  DistanceBounds bounds;
  bounds.lower = reached;
  double settled = 0.0;  // largest bound of what is not looked at again
  std::priority_queue<Piece> open;
  const auto goal = [&] {
    return std::max((1.0 + search.relative) * bounds.lower,
                    bounds.lower + search.absolute * diagonal);
  };
  const auto examine = [&](std::vector<Piece>* batch) {
    const double enough = goal();
    std::vector<double> found(batch->size(), 0.0);
    tbb::parallel_for(std::size_t{0}, batch->size(), [&](std::size_t i) {
      found[i] = Examine(target, domain, enough, &(*batch)[i]);
    });
    for (const double value : found) {
      bounds.lower = std::max(bounds.lower, value);
    }
    bounds.pieces += batch->size();
    for (const Piece& piece : *batch) {
      if (piece.upper > goal()) {
        open.push(piece);
      } else {
        settled = std::max(settled, piece.upper);
      }
    }
  };
  examine(&pieces);
  const std::size_t limit = bounds.pieces + search.budget;
  while (!open.empty() && open.top().upper > goal() && bounds.pieces < limit) {
    pieces.clear();
    for (std::size_t i = 0; i < kBatch && !open.empty(); ++i) {
      for (const Piece& half : Cut(open.top())) pieces.push_back(half);
      open.pop();
    }
    examine(&pieces);
  }
  bounds.upper = std::max(bounds.lower, settled);
  if (!open.empty()) bounds.upper = std::max(bounds.upper, open.top().upper);
  bounds.upper += kDistanceRounding * diagonal;
  return bounds;
}

}  // namespace phongpd::internal
