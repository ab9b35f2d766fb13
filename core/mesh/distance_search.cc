// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/distance_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>

#include "core/mesh/shell_orientation.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr double kRounding = 1e-14;  // of the diagonal

Vector3d CenterOf(const Piece& piece) {
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < piece.count; ++k) sum += piece.corners[k];
  return sum / piece.count;
}

std::array<Piece, 2> CutLongestEdge(const Piece& piece) {
  int a = 0, b = 1;
  double longest = -1.0;
  for (int i = 0; i < piece.count; ++i) {
    for (int j = i + 1; j < piece.count; ++j) {
      const double length = (piece.corners[i] - piece.corners[j]).squaredNorm();
      if (length > longest) {
        longest = length;
        a = i;
        b = j;
      }
    }
  }
  const Vector3d middle = 0.5 * (piece.corners[a] + piece.corners[b]);
  std::array<Piece, 2> halves = {piece, piece};
  halves[0].corners[a] = middle;
  halves[1].corners[b] = middle;
  return halves;
}

// Lowers piece->upper as far as one look can and returns a distance that is
// reached by a point that counts.  With an upper bound of `enough` or less the
// piece is of no interest and nothing is said about what it reaches.
double Examine(const DistanceTarget& target, const DistanceTarget* domain,
               double enough, Piece* piece) {
  const Vector3d c = CenterOf(*piece);
  double radius = 0.0;
  for (int k = 0; k < piece->count; ++k) {
    radius = std::max(radius, (piece->corners[k] - c).norm());
  }
  int closest = 0;
  const double distance = target.At(c, &closest);
  const double lipschitz = std::max(0.0, distance + radius);
  double convex = 0.0;
  for (int k = 0; k < piece->count && convex < lipschitz; ++k) {
    convex = std::max(convex, target.ToTriangle(closest, piece->corners[k]));
  }
  piece->upper = std::min({piece->upper, lipschitz, convex});
  if (domain == nullptr) return std::max(0.0, distance);
  if (piece->upper <= enough) return 0.0;
  int unused = 0;
  const double outside = domain->At(c, &unused);
  if (outside > radius) piece->upper = 0.0;
  return outside > 0.0 ? 0.0 : std::max(0.0, distance);
}

}  // namespace

DistanceTarget::DistanceTarget(TriangleMesh mesh, bool is_solid)
    : mesh_(std::move(mesh)), tree_(mesh_) {
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

double DistanceTarget::At(const Vector3d& x, int* closest) const {
  const SurfaceTree::Closest found = tree_.FindClosest(x);
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

double DistanceTarget::ToTriangle(int triangle, const Vector3d& x) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  return std::sqrt(ClosestOnTriangle(mesh_.vertices[a], mesh_.vertices[b],
                                     mesh_.vertices[c], x)
                       .squared_distance);
}

DistanceBounds FarthestPoint(std::vector<Piece> pieces,
                             const DistanceTarget& target,
                             const DistanceTarget* domain,
                             const DistanceSearch& search, double diagonal) {
  std::vector<double> lower(pieces.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) {
    lower[i] = Examine(target, domain, 0.0, &pieces[i]);
  });
  DistanceBounds bounds;
  for (const double reached : lower) {
    bounds.lower = std::max(bounds.lower, reached);
  }
  bounds.pieces = pieces.size();
  const std::size_t limit = pieces.size() + search.budget;
  const auto goal = [&] {
    return std::max((1.0 + search.relative) * bounds.lower,
                    bounds.lower + search.absolute * diagonal);
  };
  double settled = 0.0;  // largest bound of what is not looked at again
  std::priority_queue<Piece> open(std::less<Piece>(), std::move(pieces));
  while (!open.empty() && open.top().upper > goal() && bounds.pieces < limit) {
    const std::array<Piece, 2> halves = CutLongestEdge(open.top());
    open.pop();
    for (Piece half : halves) {
      const double reached = Examine(target, domain, goal(), &half);
      bounds.lower = std::max(bounds.lower, reached);
      ++bounds.pieces;
      if (half.upper > goal()) {
        open.push(half);
      } else {
        settled = std::max(settled, half.upper);
      }
    }
  }
  bounds.upper = std::max(bounds.lower, settled);
  if (!open.empty()) bounds.upper = std::max(bounds.upper, open.top().upper);
  bounds.upper += kRounding * diagonal;
  return bounds;
}

}  // namespace phongpd::internal
