// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: CGAL's squared_distance with exact arithmetic, and dense samples.
#include "core/bvh/segment_triangle_distance.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/bvh/triangle_bvh.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

Exact::Point_3 ToExact(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }

// The ends and the corners by CGAL, the edges by CGAL, crossing by CGAL: an
// independent composition of the same minimum.
double TrueDistance(const Vector3d& a, const Vector3d& b, const Vector3d& p,
                    const Vector3d& q, const Vector3d& r) {
  const Exact::Triangle_3 triangle(ToExact(p), ToExact(q), ToExact(r));
  const Exact::Segment_3 segment(ToExact(a), ToExact(b));
  if (!triangle.is_degenerate() && CGAL::do_intersect(triangle, segment)) {
    return 0.0;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& x : {a, b}) {
    least = std::min(least, ClosestOnTriangle(p, q, r, x).squared_distance);
  }
  for (const auto& [x, y] :
       {std::pair(p, q), std::pair(q, r), std::pair(r, p)}) {
    const Exact::Segment_3 edge(ToExact(x), ToExact(y));
    least =
        std::min(least, CGAL::to_double(CGAL::squared_distance(segment, edge)));
  }
  return std::sqrt(least);
}

void Expect(const Vector3d& a, const Vector3d& b, const Vector3d& p,
            const Vector3d& q, const Vector3d& r, double tolerance) {
  const SegmentTrianglePair pair = ClosestPair(a, b, p, q, r);
  const double distance = std::sqrt(pair.squared_distance);
  EXPECT_NEAR(distance, TrueDistance(a, b, p, q, r), tolerance);
  EXPECT_NEAR((pair.on_segment - pair.on_triangle).norm(), distance, 1e-15);
  // The points lie where they should.
  EXPECT_LE(ClosestOnTriangle(p, q, r, pair.on_triangle).squared_distance,
            1e-28);
  EXPECT_LE(ClosestOnTriangle(a, b, b, pair.on_segment).squared_distance,
            1e-28);
}

TEST(SegmentTriangleDistance, AgreesWithExactArithmetic) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] {
    const double x = uniform(random), y = uniform(random);
    return Vector3d(x, y, uniform(random));
  };
  int crossings = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d p = point(), q = point(), r = point();
    // Near, short and long segments.
    const double size = i % 3 == 0 ? 1.0 : (i % 3 == 1 ? 0.1 : 1e-3);
    const Vector3d a = point(), b = a + size * point();
    Expect(a, b, p, q, r, 1e-14);
    crossings += ClosestPair(a, b, p, q, r).squared_distance == 0.0;
  }
  EXPECT_GT(crossings, 20);
}

TEST(SegmentTriangleDistance, HoldsForSliversPointsAndParallels) {
  const Vector3d p(0.0, 0.0, 0.0), q(1.0, 0.0, 0.0);
  for (const double thin : {0.0, 1e-15, 1e-9, 1e-3}) {
    const Vector3d r(0.4, thin, 0.0);
    Expect({0.2, 0.5, 0.1}, {0.8, 0.5, 0.1}, p, q, r, 1e-14);   // parallel
    Expect({0.5, -0.5, 0.2}, {0.5, 0.5, 0.2}, p, q, r, 1e-14);  // across
    Expect({0.5, 0.0, 0.3}, {0.5, 0.0, 0.3}, p, q, r, 1e-14);   // a point
    Expect({2.0, 0.0, 0.0}, {3.0, 1e-9, 0.0}, p, q, r, 1e-14);
  }
  Expect(p, q, p, p, p, 1e-15);
  // Almost parallel edges that pass each other half way.
  Expect({0.0, -1e-8, 0.1}, {1.0, 1e-8, 0.1}, p, q, {0.5, -1.0, -1.0}, 1e-14);
}

TEST(SegmentTriangleDistance, NormalOfThePairSeparates) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto point = [&] {
    const double x = uniform(random), y = uniform(random);
    return Vector3d(x, y, uniform(random));
  };
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = point(), q = point(), r = point(), a = point(),
                   b = point();
    const SegmentTrianglePair pair = ClosestPair(a, b, p, q, r);
    if (pair.squared_distance < 1e-6) continue;
    const Vector3d n = (pair.on_segment - pair.on_triangle).normalized();
    const double level = n.dot(pair.on_triangle);
    for (const Vector3d& x : {p, q, r}) EXPECT_LE(n.dot(x), level + 1e-11);
    for (const Vector3d& x : {a, b}) {
      EXPECT_GE(n.dot(x), level + std::sqrt(pair.squared_distance) - 1e-11);
    }
  }
}

}  // namespace
}  // namespace phongpd
