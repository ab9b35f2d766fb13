// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: CGAL's exact Side_of_triangle_mesh, an independent implementation.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/bvh/exact_sign.h"
#include "core/bvh/triangle_bvh.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

CgalMesh ToCgal(const TriangleMesh& mesh) {
  CgalMesh result;
  for (const Vector3d& v : mesh.vertices) {
    result.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
  }
  using Index = CgalMesh::Vertex_index;
  for (const Triangle& t : mesh.triangles) {
    result.add_face(Index(static_cast<unsigned>(t[0])),
                    Index(static_cast<unsigned>(t[1])),
                    Index(static_cast<unsigned>(t[2])));
  }
  return result;
}

struct Counts {
  int inside = 0;
  int outside = 0;
  int on_surface = 0;
};

Counts Compare(const TriangleMesh& mesh, const std::vector<Vector3d>& points) {
  const CgalMesh cgal = ToCgal(mesh);
  const CGAL::Side_of_triangle_mesh<CgalMesh, Kernel> side(cgal);
  const TriangleBvh test(mesh);
  Counts counts;
  for (const Vector3d& q : points) {
    const auto truth = side(Kernel::Point_3(q.x(), q.y(), q.z()));
    const Location expected = truth == CGAL::ON_BOUNDED_SIDE ? Location::kInside
                              : truth == CGAL::ON_BOUNDARY
                                  ? Location::kOnSurface
                                  : Location::kOutside;
    EXPECT_EQ(test.Locate(q), expected) << q.transpose();
    counts.inside += expected == Location::kInside;
    counts.outside += expected == Location::kOutside;
    counts.on_surface += expected == Location::kOnSurface;
  }
  return counts;
}

// Every combination of the coordinates that vertices have, and the middles
// between neighbours: points aligned with vertices, edges and faces.
std::vector<Vector3d> Grid(const TriangleMesh& mesh) {
  std::vector<double> values[3];
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& v = values[axis];
    for (const Vector3d& q : mesh.vertices) v.push_back(q[axis]);
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
    const std::size_t size = v.size();
    for (std::size_t i = 0; i + 1 < size; ++i) {
      v.push_back(0.5 * (v[i] + v[i + 1]));
    }
  }
  std::vector<Vector3d> points;
  for (const double x : values[0]) {
    for (const double y : values[1]) {
      for (const double z : values[2]) points.emplace_back(x, y, z);
    }
  }
  return points;
}

TEST(TriangleBvhInside, AgreesWithCgalOnGridsThroughVerticesEdgesAndFaces) {
  for (const TriangleMesh& mesh :
       {MakeBox({-1, -1, -1}, {1, 1, 1}), MakeAxes(2.0, 0.25),
        MakeL(2.0, 0.5, 0.75), MakeU(2.0, 0.25, 0.5),
        MakePlateWithHole(2.0, 0.25, 0.5), MakeVessel(2.0, 1.0, 0.5),
        MakeVessel(2.0, 1.0, 0.0)}) {
    const Counts counts = Compare(mesh, Grid(mesh));
    EXPECT_GT(counts.inside, 0);
    EXPECT_GT(counts.on_surface, 0);
  }
}

TEST(TriangleBvhInside, AgreesWithCgalAtRandomPointsAndOnVerticesAndEdges) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const TriangleMesh& mesh :
       {MakeIcoBall(1.0, 3), MakeWrench(), MakeKnot(1.0, 0.2, 80, 12),
        Rotated(MakeU(2.0, 0.25, 0.5), GenericRotation())}) {
    const BoundingBox box = ComputeBounds(mesh);
    std::vector<Vector3d> points = mesh.vertices;
    for (int i = 0; i < 5000; ++i) {
      const Vector3d u(uniform(engine), uniform(engine), uniform(engine));
      points.push_back(box.min + u.cwiseProduct(box.max - box.min));
    }
    for (const Triangle& t : mesh.triangles) {
      const Vector3d& a = mesh.vertices[t[0]];
      const Vector3d& b = mesh.vertices[t[1]];
      points.push_back(0.5 * (a + b));         // within an ulp of the surface
      points.emplace_back(a.x(), a.y(), 0.0);  // below a vertex
      points.emplace_back(a.x(), b.y(), b.z());
    }
    const Counts counts = Compare(mesh, points);
    EXPECT_GE(counts.on_surface, static_cast<int>(mesh.vertices.size()));
    EXPECT_GT(counts.inside, 100);
    EXPECT_GT(counts.outside, 100);
  }
}

TEST(TriangleBvhInside, DecidesWithinOneUlpOfAFace) {
  const TriangleBvh box(MakeBox({-1, -1, -1}, {1, 1, 1}));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Vector3d q(0.3, 0.3, 0.3);
      q[axis] = sign;
      EXPECT_EQ(box.Locate(q), Location::kOnSurface);
      q[axis] = sign * std::nextafter(1.0, 0.0);
      EXPECT_EQ(box.Locate(q), Location::kInside);
      q[axis] = sign * std::nextafter(1.0, 2.0);
      EXPECT_EQ(box.Locate(q), Location::kOutside);
    }
  }
}

TEST(TriangleBvhInside, SurvivesDenormalsHugeScalesAndNonFiniteInput) {
  constexpr double kTiny = 5e-324;
  for (const double scale : {1e-300, 1e-100, 1.0, 1e100, 1e300}) {
    const TriangleBvh box(Scaled(MakeBox({-1, -1, -1}, {1, 1, 1}), scale));
    EXPECT_EQ(box.Locate({kTiny, -kTiny, kTiny}), Location::kInside);
    EXPECT_EQ(box.Locate({scale, kTiny, kTiny}), Location::kOnSurface);
    EXPECT_EQ(box.Locate({kTiny, kTiny, scale}), Location::kOnSurface);
    EXPECT_EQ(box.Locate({1.7e308, kTiny, 0.0}), Location::kOutside);
    EXPECT_EQ(box.Locate({NAN, 0.0, 0.0}), Location::kOutside);
    EXPECT_EQ(box.Locate({0.0, INFINITY, 0.0}), Location::kOutside);
  }
}

TEST(ExactSign, IsAntisymmetricAndExactNearZero) {
  // 0.1 + 0.2 ≠ 0.3 in binary: nearly collinear, and the last bit decides.
  EXPECT_EQ(Orient2d(0, 0, 1, 1, 0.3, 0.3), 0);
  EXPECT_EQ(Orient2d(0, 0, 1, 1, 0.3, 0.1 + 0.2), 1);
  EXPECT_EQ(Orient2d(1, 1, 0, 0, 0.3, 0.1 + 0.2), -1);
  EXPECT_EQ(Orient2d(0, 0, 5e-324, 0, 0, 5e-324), 1);
  const double a[] = {0, 0, 0}, b[] = {1e-200, 0, 0}, c[] = {0, 1e-200, 0};
  const double above[] = {0, 0, 5e-324}, on[] = {3e-201, 3e-201, 0};
  EXPECT_EQ(Orient3d(a, b, c, above), 1);
  EXPECT_EQ(Orient3d(b, a, c, above), -1);
  EXPECT_EQ(Orient3d(a, b, c, on), 0);
}

// The same determinant by two routes: expansions at scale 1, rationals at a
// scale where its products underflow.
TEST(ExactSign, RoutesAgreeOnNearlyDegenerateInput) {
  std::mt19937 engine(21);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double tiny = std::ldexp(1.0, -700);
  int signs[3] = {0, 0, 0};
  for (int i = 0; i < 5000; ++i) {
    Vector3d p[4];
    for (Vector3d& v : p) {
      v = Vector3d(uniform(engine), uniform(engine), uniform(engine));
    }
    // Coplanar up to the rounding of this line, or on a coarse grid exactly.
    if (i % 2 == 0) p[3] = p[0] + 0.3 * (p[1] - p[0]) + 0.4 * (p[2] - p[0]);
    if (i % 2 == 1) {
      for (Vector3d& v : p) v = (2.0 * v).array().round() * 0.1;
    }
    Vector3d small[4];
    for (int k = 0; k < 4; ++k) small[k] = tiny * p[k];
    const int sign =
        Orient3d(p[0].data(), p[1].data(), p[2].data(), p[3].data());
    EXPECT_EQ(sign, Orient3d(small[0].data(), small[1].data(), small[2].data(),
                             small[3].data()));
    EXPECT_EQ(sign,
              -Orient3d(p[1].data(), p[0].data(), p[2].data(), p[3].data()));
    ++signs[sign + 1];
    const Vector3d c = i % 2 ? p[2] : Vector3d(p[0] + 0.3 * (p[1] - p[0]));
    EXPECT_EQ(Orient2d(p[0].x(), p[0].y(), p[1].x(), p[1].y(), c.x(), c.y()),
              Orient2d(small[0].x(), small[0].y(), small[1].x(), small[1].y(),
                       tiny * c.x(), tiny * c.y()));
  }
  for (const int count : signs) EXPECT_GT(count, 200);
}

// Truth: boxes that hold the point.
TEST(TriangleBvhInside, CountsHowOftenComponentsHoldAPoint) {
  std::mt19937_64 random(5);
  const auto coordinate = [&] { return static_cast<double>(random() % 9); };
  int most = 0, least = 0;
  for (int run = 0; run < 60; ++run) {
    struct Box {
      Vector3d min, max;
      int sign;
    };
    std::vector<Box> boxes;
    TriangleMesh mesh;
    for (int i = 0; i < 5; ++i) {
      const Vector3d min(coordinate(), coordinate(), coordinate());
      const Vector3d max = min + Vector3d(1.0, 1.0, 1.0) +
                           Vector3d(coordinate(), coordinate(), coordinate());
      boxes.push_back({min, max, i % 3 == 2 ? -1 : 1});
      const TriangleMesh outward = MakeBox(min, max);
      const TriangleMesh box =
          boxes.back().sign < 0 ? Reversed(outward) : outward;
      mesh = i == 0 ? box : Joined(mesh, box);
    }
    const TriangleBvh tree(mesh);
    for (int i = 0; i < 300; ++i) {
      // Above and below edges and corners, on surfaces, and anywhere.
      Vector3d q(coordinate(), coordinate(), coordinate());
      if (i % 2 == 0) q += 0.5 * Vector3d(i % 3, i % 5 % 2, 1.0);
      int expected = 0;
      bool on_surface = false;
      for (const Box& box : boxes) {
        const bool is_within = (q.array() >= box.min.array()).all() &&
                               (q.array() <= box.max.array()).all();
        const bool is_inside = (q.array() > box.min.array()).all() &&
                               (q.array() < box.max.array()).all();
        expected += is_inside ? box.sign : 0;
        on_surface = on_surface || (is_within && !is_inside);
      }
      if (on_surface) expected = 0;
      ASSERT_EQ(tree.WindingNumber(q), expected) << q.transpose();
      most = std::max(most, expected);
      least = std::min(least, expected);
    }
    EXPECT_EQ(tree.WindingNumber({std::nan(""), 0.0, 0.0}), 0);
  }
  EXPECT_GE(most, 3);
  EXPECT_EQ(least, -1);
}

}  // namespace
}  // namespace phongpd
