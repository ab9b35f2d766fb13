// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: CGAL's exact predicates, triangle by triangle, and its exact
// constructions for where segments meet.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Object.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "core/bvh/triangle_bvh.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

TriangleMesh UnitBox() {
  return MakeBox(Vector3d::Constant(-0.5), Vector3d::Constant(0.5));
}

template <typename Kernel>
typename Kernel::Point_3 ToPoint(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

template <typename Kernel>
typename Kernel::Triangle_3 ToTriangle(const TriangleMesh& mesh,
                                       const Triangle& t) {
  return {ToPoint<Kernel>(mesh.vertices[t[0]]),
          ToPoint<Kernel>(mesh.vertices[t[1]]),
          ToPoint<Kernel>(mesh.vertices[t[2]])};
}

bool TrulyMeets(const TriangleMesh& mesh, const Vector3d& a,
                const Vector3d& b) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const Kernel::Segment_3 segment(ToPoint<Kernel>(a), ToPoint<Kernel>(b));
  for (const Triangle& t : mesh.triangles) {
    const auto triangle = ToTriangle<Kernel>(mesh, t);
    if (triangle.is_degenerate()) continue;
    if (segment.is_degenerate() ? triangle.has_on(segment.source())
                                : CGAL::do_intersect(triangle, segment)) {
      return true;
    }
  }
  return false;
}

// Smallest fraction of the way from a to b, constructed exactly.
std::optional<double> TrueFraction(const TriangleMesh& mesh, const Vector3d& a,
                                   const Vector3d& b) {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  const Kernel::Point_3 from = ToPoint<Kernel>(a), to = ToPoint<Kernel>(b);
  const Kernel::Vector_3 way = to - from;
  std::optional<double> first;
  const auto keep = [&](const Kernel::Point_3& p) {
    const double t = CGAL::to_double(((p - from) * way) / way.squared_length());
    if (!first || t < *first) first = t;
  };
  for (const Triangle& t : mesh.triangles) {
    const auto triangle = ToTriangle<Kernel>(mesh, t);
    if (triangle.is_degenerate()) continue;
    const CGAL::Object part =
        CGAL::intersection(triangle, Kernel::Segment_3(from, to));
    if (const auto* p = CGAL::object_cast<Kernel::Point_3>(&part)) keep(*p);
    if (const auto* s = CGAL::object_cast<Kernel::Segment_3>(&part)) {
      keep(s->source());
      keep(s->target());
    }
  }
  return first;
}

// Ends on a lattice that holds the shape's own coordinates, so that segments
// lie in facets, along edges and through vertices, beside random ones.
Vector3d LatticePoint(std::mt19937_64& random) {
  std::uniform_int_distribution<int> step(-6, 6);
  return Vector3d(step(random), step(random), step(random)) * 0.25;
}

TEST(TriangleBvhSegments, AgreesWithExactPredicatesOnALattice) {
  const TriangleMesh solids[] = {UnitBox(), MakeL(2.0, 0.5, 1.0),
                                 MakeVessel(3.0, 2.0, 1.0)};
  std::mt19937_64 random(1);
  for (const TriangleMesh& solid : solids) {
    const TriangleBvh tree(solid);
    int met = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vector3d a = LatticePoint(random), b = LatticePoint(random);
      const bool truth = TrulyMeets(solid, a, b);
      ASSERT_EQ(tree.Meets(a, b), truth)
          << a.transpose() << " to " << b.transpose();
      const TriangleBvh::Hit hit = tree.FirstHit(a, b);
      ASSERT_EQ(hit.Found(), truth);
      met += truth;
      if (!truth || a == b) continue;
      ASSERT_NEAR(hit.fraction, *TrueFraction(solid, a, b), 1e-14)
          << a.transpose() << " to " << b.transpose();
    }
    EXPECT_GT(met, 500);
  }
}

TEST(TriangleBvhSegments, AgreesWithExactPredicatesBesideTheSurface) {
  std::mt19937_64 random(2);
  const TriangleMesh solid =
      Rotated(MakeStar(0.4, 1.0), testing::RandomRotation(&random));
  const TriangleBvh tree(solid);
  std::uniform_real_distribution<double> exponent(-17.0, 0.0);
  int met = 0, missed = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d p = testing::RandomSurfacePoint(solid, &random).position;
    const Vector3d u = testing::RandomRotation(&random).col(0);
    const Vector3d v = testing::RandomRotation(&random).col(0);
    const Vector3d a = p + std::pow(10.0, exponent(random)) * u;
    const Vector3d b = p + std::pow(10.0, exponent(random)) * v;
    const bool truth = TrulyMeets(solid, a, b);
    ASSERT_EQ(tree.Meets(a, b), truth);
    ASSERT_EQ(tree.FirstHit(a, b).Found(), truth);
    (truth ? met : missed) += 1;
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(missed, 500);
}

TEST(TriangleBvhSegments, DecidesAtEveryScaleAndOffset) {
  std::mt19937_64 random(3);
  const TriangleMesh box = UnitBox();
  for (const int power : {-490, -30, 0, 30, 490}) {
    const double scale = std::ldexp(1.0, power);
    const TriangleMesh solid = Scaled(box, scale);
    const TriangleBvh tree(solid);
    for (int i = 0; i < 300; ++i) {
      const Vector3d a = scale * LatticePoint(random);
      const Vector3d b = scale * LatticePoint(random);
      EXPECT_EQ(tree.Meets(a, b), TriangleBvh(box).Meets(a / scale, b / scale))
          << scale;
    }
  }
  const Vector3d far(1e6, -1e6, 1e6);
  const TriangleMesh solid = Translated(box, far);
  const TriangleBvh tree(solid);
  for (int i = 0; i < 500; ++i) {
    const Vector3d a = far + LatticePoint(random);
    const Vector3d b = far + LatticePoint(random);
    EXPECT_EQ(tree.Meets(a, b), TrulyMeets(solid, a, b));
  }
}

TEST(TriangleBvhSegments, VisitsEveryTriangleASegmentMeets) {
  const TriangleMesh box = UnitBox();
  const TriangleBvh tree(box);
  int count = 0;
  tree.ForEachHit({-2.0, 0.1, 0.2}, {2.0, 0.1, 0.2},
                  [&](int triangle, double fraction) {
                    EXPECT_GE(triangle, 0);
                    EXPECT_NEAR(std::abs(fraction - 0.5), 0.125, 1e-15);
                    ++count;
                  });
  EXPECT_EQ(count, 2);
}

TEST(TriangleBvhSegments, LeavesOutWhatTouchesTheStartOfARay) {
  const TriangleMesh box = UnitBox();
  const TriangleBvh tree(box);
  const Vector3d edge(0.5, 0.5, 0.1), across(-2.0, -2.0, 0.1);
  EXPECT_EQ(tree.FirstHit(edge, across).fraction, 0.0);
  const TriangleBvh::Hit hit = tree.FirstHitBeyond(edge, across, 1e-12);
  ASSERT_TRUE(hit.Found());
  EXPECT_NEAR(hit.fraction, 0.4, 1e-15);
  EXPECT_FALSE(tree.FirstHitBeyond(edge, {2.0, 2.0, 0.1}, 1e-12).Found());
}

TEST(TriangleBvhSegments, SkipsTrianglesWithoutArea) {
  TriangleMesh mesh = UnitBox();
  mesh.vertices.push_back({2.0, 0.0, 0.0});
  mesh.vertices.push_back({3.0, 0.0, 0.0});
  mesh.triangles.push_back({8, 9, 8});
  const TriangleBvh tree(mesh);
  EXPECT_FALSE(tree.Meets({2.5, -1.0, 0.0}, {2.5, 1.0, 0.0}));
  EXPECT_TRUE(tree.Meets({0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}));
}

TEST(TriangleBvhSegments, MeasuresTheDistanceOfSegments) {
  const double infinity = std::numeric_limits<double>::infinity();
  const TriangleBvh box(UnitBox());
  // Along a face, across an edge, past a corner, a point, and inside.
  EXPECT_DOUBLE_EQ(box.Distance({-2, 0.1, 0.75}, {2, 0.2, 0.75}, infinity),
                   0.25);
  EXPECT_DOUBLE_EQ(box.Distance({0, 2, -0.5}, {0, -0.5, 2}, infinity),
                   0.25 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(box.Distance({0.5, 0.5, 1.5}, {2, 2, 1.5}, infinity), 1.0);
  EXPECT_DOUBLE_EQ(box.Distance({1, 1, 1}, {1, 1, 1}, infinity),
                   0.5 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(box.Distance({-0.25, 0, 0}, {0.25, 0, 0}, infinity), 0.25);
  EXPECT_EQ(box.Distance({-2, 0, 0}, {2, 0, 0}, infinity), 0.0);
  // The limit, and what touches.
  EXPECT_EQ(box.Distance({-2, 0, 0.75}, {2, 0, 0.75}, 0.1), 0.1);
  EXPECT_EQ(box.Distance({-2, 0, 0.5}, {2, 0, 0.5}, 0.1), 0.0);
  const double beside = std::nextafter(0.5, 1.0);
  EXPECT_GT(box.Distance({-2, 0, beside}, {2, 0, beside}, 0.1), 0.0);

  std::mt19937_64 random(11);
  const TriangleMesh torus =
      Rotated(MakeTorus(2.0, 0.5, 40, 20), testing::RandomRotation(&random));
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const TriangleMesh mesh = Scaled(torus, scale);
    const TriangleBvh segments(mesh);
    const TriangleBvh surface(mesh);
    const BoundingBox bounds = ComputeBounds(mesh);
    for (int i = 0; i < 200; ++i) {
      const Vector3d a = testing::RandomPoint(bounds, &random);
      const Vector3d b = testing::RandomPoint(bounds, &random);
      const double distance = segments.Distance(a, b, infinity);
      EXPECT_EQ(distance == 0.0, segments.Meets(a, b));
      EXPECT_EQ(distance == 0.0, segments.ComesWithin(a, b, 0.0));
      EXPECT_TRUE(segments.ComesWithin(a, b, 1.1 * distance + 1e-9 * scale));
      constexpr int kSamples = 500;
      double sampled = infinity;
      for (int k = 0; k <= kSamples; ++k) {
        const Vector3d x = a + (double{1} * k / kSamples) * (b - a);
        sampled = std::min(sampled, surface.FindClosest(x).distance);
      }
      EXPECT_LE(distance, sampled + 1e-14 * scale);
      EXPECT_GE(distance, sampled - 0.5 * (b - a).norm() / kSamples);
      const double limit = 0.7 * distance;
      if (limit > 0.0) {
        EXPECT_EQ(segments.Distance(a, b, limit), limit);
        EXPECT_FALSE(segments.ComesWithin(a, b, limit));
      }
    }
  }
}

TEST(TriangleBvhSegments, IgnoresSliversThatTheStartTouches) {
  // Where a ray hits a sliver it starts on is less certain than an ulp.
  std::mt19937_64 random(12);
  for (int i = 0; i < 200; ++i) {
    const TriangleMesh mesh = Rotated(MakeBox({4, 4, 4}, {4 + 1e-4, 5, 5}),
                                      testing::RandomRotation(&random));
    const TriangleBvh segments(mesh);
    for (const Triangle& t : mesh.triangles) {
      const Vector3d& a = mesh.vertices[t[0]];
      const Vector3d& b = mesh.vertices[t[1]];
      const Vector3d& c = mesh.vertices[t[2]];
      const Vector3d up = (b - a).cross(c - a).normalized();
      for (const Vector3d& x :
           {Vector3d(0.5 * (a + b)), Vector3d((a + b + c) / 3.0)}) {
        EXPECT_FALSE(segments.FirstHitBeyond(x, x + up, 1e-11).Found());
      }
    }
  }
}

}  // namespace
}  // namespace phongpd
