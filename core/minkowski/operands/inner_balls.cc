// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/inner_balls.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Points of the surface at which balls are tried, for each that is asked for.
constexpr std::size_t kTries = 3;
// Steps in which a ball shrinks; more hardly change it.
constexpr int kSteps = 12;
constexpr double kConverged = 1e-6;
// A ball whose center is within this share of a larger one's radius, and that
// reaches out of it by no more than this share of its own, adds little.
constexpr double kNear = 0.5;
constexpr double kBeyond = 0.25;

// A point of the surface and the direction into the solid.
struct Seed {
  Vector3d point, inward;
};

// Evenly by area; within facets by a sequence of low discrepancy (Roberts' R2).
std::vector<Seed> Seeds(const GridSolid& solid, std::size_t count) {
  const auto at = [&](int v) { return ToDouble(solid.vertices[v]); };
  std::vector<Vector3d> normals;  // twice the area long
  double all = 0.0;
  for (const Triangle& t : solid.facets) {
    normals.push_back((at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])));
    all += normals.back().norm();
  }
  std::vector<Seed> seeds;
  const double share = all / static_cast<double>(count);
  double reached = 0.0;
  for (std::size_t f = 0; f < solid.facets.size(); ++f) {
    const double area = normals[f].norm();
    reached += area;
    while ((static_cast<double>(seeds.size()) + 0.5) * share < reached) {
      const auto i = static_cast<double>(seeds.size());
      double u = std::fmod(0.5 + 0.7548776662466927 * i, 1.0);
      double v = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Triangle& t = solid.facets[f];
      seeds.push_back({(1.0 - u - v) * at(t[0]) + u * at(t[1]) + v * at(t[2]),
                       -normals[f] / area});
    }
  }
  return seeds;
}

// The ball that touches the surface at the seed; radius 0 where there is none.
InnerBall BallAt(const Seed& seed, const GridSolid& solid,
                 const TriangleBvh& bvh, double radius) {
  InnerBall ball;
  double distance = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    ball.center = seed.point + radius * seed.inward;
    const TriangleBvh::Closest closest = bvh.FindClosest(ball.center);
    distance = closest.distance;
    if (distance >= (1.0 - kConverged) * radius) break;
    Vector3d nearest = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      nearest += closest.lambda[k] *
                 ToDouble(solid.vertices[solid.facets[closest.triangle][k]]);
    }
    const Vector3d chord = nearest - seed.point;
    const double depth = chord.dot(seed.inward);
    if (!(depth > 0.0)) break;
    radius = std::min(radius, chord.squaredNorm() / (2.0 * depth));
  }
  if (bvh.WindingNumber(ball.center) > 0) ball.radius = distance;
  return ball;
}

bool AddsLittle(const InnerBall& ball, const std::vector<InnerBall>& kept) {
  return std::any_of(kept.begin(), kept.end(), [&](const InnerBall& larger) {
    const double apart = (ball.center - larger.center).norm();
    return apart < kNear * larger.radius &&
           apart + ball.radius < larger.radius + kBeyond * ball.radius;
  });
}

}  // namespace

TriangleBvh BvhOf(const GridSolid& solid) {
  TriangleMesh mesh;
  mesh.vertices.reserve(solid.vertices.size());
  for (const GridPoint& v : solid.vertices) {
    mesh.vertices.push_back(ToDouble(v));
  }
  mesh.triangles = solid.facets;
  return TriangleBvh(mesh);
}

std::vector<InnerBall> InnerBalls(const GridSolid& solid,
                                  const TriangleBvh& bvh, std::size_t most) {
  const std::vector<Seed> seeds = Seeds(solid, kTries * most);
  const BoxTree::Node& root = bvh.tree().nodes().front();
  const double largest = 0.5 * (root.max - root.min).minCoeff();
  std::vector<InnerBall> balls(seeds.size());
  tbb::parallel_for(std::size_t{0}, seeds.size(), [&](std::size_t i) {
    balls[i] = BallAt(seeds[i], solid, bvh, largest);
  });
  std::stable_sort(balls.begin(), balls.end(),
                   [](const InnerBall& a, const InnerBall& b) {
                     return a.radius > b.radius;
                   });
  std::vector<InnerBall> kept;
  for (const InnerBall& ball : balls) {
    if (kept.size() == most || !(ball.radius > 0.0)) break;
    if (!AddsLittle(ball, kept)) kept.push_back(ball);
  }
  return kept;
}

}  // namespace phongpd::internal
