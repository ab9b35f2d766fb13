// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/ring_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/mesh/numbers.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

using internal::kInfinity;

// Lets `triangle` offer a projection closer to `contact` than *best.
void Offer(const FieldProjector& projector, const Vector3d& x,
           const Vector3d& contact, int triangle, const Vector3d& start,
           double* distance, Projection* best) {
  std::array<Projection, 3> found;
  const int count = projector.Project(triangle, x, kInfinity, start, &found);
  for (int i = 0; i < count; ++i) {
    const double d = (projector.Point(found[i]) - contact).norm();
    if (d < *distance) {
      *distance = d;
      *best = found[i];
    }
  }
}

// Nearest contact on the previous triangle, then in its first ring.
Projection NearestInRing(const FieldProjector& projector,
                         const BranchWalk& walk, const Vector3d& x,
                         const Projection& previous, double reach) {
  const Vector3d contact = projector.Point(previous);
  Projection best;
  double distance = reach;
  Offer(projector, x, contact, previous.triangle, previous.lambda, &distance,
        &best);
  if (best.IsValid()) return best;
  for (const int v : projector.field().mesh.triangles[previous.triangle]) {
    for (int i = walk.fan_start()[v]; i < walk.fan_start()[v + 1]; ++i) {
      Offer(projector, x, contact, walk.fan()[i], Vector3d::Constant(1.0 / 3.0),
            &distance, &best);
    }
  }
  return best;
}

}  // namespace

Projection SearchRings(const FieldProjector& projector, const BranchWalk& walk,
                       const Vector3d& x, const Projection& previous,
                       int rings) {
  const TriangleMesh& mesh = projector.field().mesh;
  std::vector<char> seen(mesh.triangles.size(), 0);
  std::vector<int> reached{previous.triangle};
  seen[previous.triangle] = 1;
  std::size_t ring_begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t ring_end = reached.size();
    for (std::size_t i = ring_begin; i < ring_end; ++i) {
      const Triangle triangle = mesh.triangles[reached[i]];
      for (const int v : triangle) {
        for (int k = walk.fan_start()[v]; k < walk.fan_start()[v + 1]; ++k) {
          const int next = walk.fan()[k];
          if (seen[next]) continue;
          seen[next] = 1;
          reached.push_back(next);
        }
      }
    }
    ring_begin = ring_end;
  }
  const Vector3d contact = projector.Point(previous);
  Projection best;
  double distance = kInfinity;
  for (const int triangle : reached) {
    Offer(projector, x, contact, triangle, Vector3d::Constant(1.0 / 3.0),
          &distance, &best);
  }
  return best;
}

Projection FollowByNewton(const FieldProjector& projector,
                          const BranchWalk& walk, const Vector3d& x,
                          const Projection& previous) noexcept {
  // Lengths refer to the field frame, whose diagonal is in [1, 2).
  constexpr double kLongestMove = 0.005;
  constexpr double kShortestMove = 1e-6;
  constexpr double kMagnification = 8.0;
  constexpr int kMaxSteps = 1024;
  Projection now = previous;
  Vector3d at = projector.Point(now) + now.s * projector.UnitNormal(now);
  double length = kLongestMove;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vector3d rest = x - at;
    const double distance = rest.norm();
    const bool last = distance <= length;
    const Vector3d target = last ? x : Vector3d(at + length / distance * rest);
    const double reach = kMagnification * std::min(length, distance) + 1e-12;
    const Projection next = NearestInRing(projector, walk, target, now, reach);
    if (!next.IsValid()) {
      length = 0.25 * std::min(length, distance);
      if (length < kShortestMove) return {};
      continue;
    }
    now = next;
    if (last) return now;
    at = target;
    length = std::min(2.0 * length, kLongestMove);
  }
  return {};
}

}  // namespace phongpd
