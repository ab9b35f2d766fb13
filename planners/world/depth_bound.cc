// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/depth_bound.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kNormals = 256;  // of each solid, at most
constexpr std::size_t kTried = 16;     // directions, beyond the lattice's
constexpr int kHalvings = 12;          // of the last way: 1/4096 of it

// The 26 directions to the neighbours of a lattice point, axes first, so that
// a tie is told along an axis.
std::vector<Vector3d> LatticeDirections() {
  std::vector<Vector3d> directions;
  for (int k = 0; k < 27; ++k) {
    const Vector3d v(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    if (k != 13) directions.push_back(v);
  }
  std::stable_sort(directions.begin(), directions.end(),
                   [](const Vector3d& a, const Vector3d& b) {
                     return a.squaredNorm() < b.squaredNorm();
                   });
  for (Vector3d& v : directions) v.normalize();
  return directions;
}

// Outward normals of triangles spread over the mesh, times `sign`.
void AddNormals(const TriangleMesh& mesh, double sign,
                std::vector<Vector3d>* directions) {
  const std::size_t count = mesh.triangles.size();
  const std::size_t taken = std::min(count, kNormals);
  for (std::size_t i = 0; i < taken; ++i) {
    const Triangle& t = mesh.triangles[i * count / taken];
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vector3d& b = mesh.vertices[static_cast<std::size_t>(t[1])];
    const Vector3d& c = mesh.vertices[static_cast<std::size_t>(t[2])];
    const Vector3d normal =
        (b - a).stableNormalized().cross((c - a).stableNormalized());
    const double length = normal.norm();
    // Any direction will do, but it has to be one.
    if (length > 1e-6) directions->push_back(sign / length * normal);
  }
}

double HullExit(const TriangleMesh& robot, const TriangleMesh& obstacle,
                const Vector3d& q, const Vector3d& direction) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Vector3d& b : obstacle.vertices) {
    highest = std::max(highest, direction.dot(b));
  }
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& a : robot.vertices) {
    lowest = std::min(lowest, direction.dot(a + q));
  }
  return std::max(0.0, highest - lowest);
}

}  // namespace

WayOut BoundDepth(const TriangleMesh& robot, const TriangleMesh& obstacle,
                  const Vector3d& q, const MotionOracle& oracle) {
  std::vector<Vector3d> directions = LatticeDirections();
  const std::size_t lattice = directions.size();
  AddNormals(obstacle, 1.0, &directions);
  AddNormals(robot, -1.0, &directions);
  std::vector<WayOut> ways;
  for (const Vector3d& direction : directions) {
    ways.push_back({HullExit(robot, obstacle, q, direction), direction});
  }
  const auto is_shorter = [](const WayOut& a, const WayOut& b) {
    return a.length < b.length;
  };
  WayOut best = *std::min_element(ways.begin(), ways.end(), is_shorter);
  if (best.length == 0.0) return best;
  std::stable_sort(ways.begin() + static_cast<std::ptrdiff_t>(lattice),
                   ways.end(), is_shorter);
  ways.resize(std::min(ways.size(), lattice + kTried));

  // Parts of hulls are hollow: a shorter way may be free already.
  const double hull = best.length;
  const auto try_way = [&](const Vector3d& direction, double length) {
    const Vector3d there = q + length * direction;
    if (oracle.Collides(there)) return false;
    best = {(there - q).norm(), direction};
    return true;
  };
  for (const WayOut& way : ways) {
    for (const double share : {0.0625, 0.125, 0.25, 0.5}) {
      const double length = share * hull;
      if (length >= best.length) break;
      if (try_way(way.direction, length)) break;
    }
  }
  if (best.length == hull) return best;
  const Vector3d direction = best.direction;
  double blocked = 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (blocked + best.length);
    if (!try_way(direction, middle)) blocked = middle;
  }
  return best;
}

}  // namespace phongpd
