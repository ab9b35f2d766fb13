// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: all triangles, CGAL's AABB tree, closed forms of ball and box.
#include "core/projection/euclidean_metric.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

std::vector<Vector3d> RandomPoints(const TriangleMesh& mesh, int count,
                                   double inflate) {
  std::mt19937 engine(10);
  std::uniform_real_distribution<double> uniform(-inflate, 1.0 + inflate);
  const BoundingBox box = ComputeBounds(mesh);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const Vector3d u(uniform(engine), uniform(engine), uniform(engine));
    points.push_back(box.min + u.cwiseProduct(box.max - box.min));
  }
  return points;
}

TEST(EuclideanMetric, AgreesWithBruteForceAndWithCgal) {
  for (const TriangleMesh& mesh :
       {MakeIcoBall(1.0, 3), MakeWrench(), MakeU(2.0, 0.25, 0.5),
        MakeKnot(1.0, 0.2, 80, 12), MakeCone(0.5, 3.0, 200),
        Rotated(MakeStar(1.0, 1.5), GenericRotation())}) {
    const double diagonal = ComputeBounds(mesh).Diagonal();
    CgalMesh cgal;
    for (const Vector3d& v : mesh.vertices) {
      cgal.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
    }
    using Index = CgalMesh::Vertex_index;
    for (const Triangle& t : mesh.triangles) {
      cgal.add_face(Index(static_cast<unsigned>(t[0])),
                    Index(static_cast<unsigned>(t[1])),
                    Index(static_cast<unsigned>(t[2])));
    }
    const CgalTree tree(faces(cgal).first, faces(cgal).second, cgal);
    const EuclideanMetric metric(TakeAsContactSpace(mesh));
    for (const Vector3d& q : RandomPoints(mesh, 1000, 0.3)) {
      const PenetrationResult result = metric.Query(q);
      double least = std::numeric_limits<double>::infinity();
      for (const Triangle& t : mesh.triangles) {
        least = std::min(
            least, ClosestOnTriangle(mesh.vertices[t[0]], mesh.vertices[t[1]],
                                     mesh.vertices[t[2]], q)
                       .squared_distance);
      }
      const double distance = std::abs(result.signed_distance);
      EXPECT_NEAR(distance, std::sqrt(least), 1e-14 * diagonal);
      const double cgal_distance = std::sqrt(
          tree.squared_distance(Kernel::Point_3(q.x(), q.y(), q.z())));
      EXPECT_NEAR(distance, cgal_distance, 1e-12 * diagonal);
      EXPECT_NEAR((q - result.contact).norm(), distance, 1e-14 * diagonal);
      const Vector3d arrived = q - result.signed_distance * result.direction;
      EXPECT_LT((arrived - result.contact).norm(), 1e-12 * diagonal);
      EXPECT_EQ(result.gradient, result.direction);
    }
  }
}

TEST(EuclideanMetric, IsTheClosedFormOfABox) {
  const EuclideanMetric metric(
      TakeAsContactSpace(MakeBox({-1, -2, -3}, {1, 2, 3})));
  for (const Vector3d& q :
       RandomPoints(MakeBox({-1, -2, -3}, {1, 2, 3}), 2000, 0.4)) {
    const Vector3d d = q.cwiseAbs() - Vector3d(1, 2, 3);
    const double truth =
        d.maxCoeff() < 0.0 ? d.maxCoeff() : d.cwiseMax(0.0).norm();
    EXPECT_NEAR(metric.Query(q).signed_distance, truth, 1e-14);
  }
}

TEST(EuclideanMetric, GivesTheFacetNormalOnTheSurface) {
  const EuclideanMetric metric(
      TakeAsContactSpace(MakeBox({-1, -1, -1}, {1, 1, 1})));
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d q(0.25, 0.5, -0.25);
    q[axis] = -1.0;
    const PenetrationResult result = metric.Query(q);
    EXPECT_EQ(result.status, QueryStatus::kOk);
    EXPECT_FALSE(result.inside);
    EXPECT_EQ(result.signed_distance, 0.0);
    EXPECT_EQ(result.direction, Vector3d(-Vector3d::Unit(axis)));
    EXPECT_EQ(result.contact, q);
  }
  const PenetrationResult corner = metric.Query(Vector3d(1, 1, 1));
  EXPECT_EQ(corner.signed_distance, 0.0);
  EXPECT_NEAR(corner.direction.norm(), 1.0, 1e-15);
}

TEST(ClosestOnTriangle, HoldsForSliversAndDegenerateTriangles) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double thickness : {1.0, 1e-3, 1e-6, 1e-9, 1e-15, 0.0}) {
    for (int i = 0; i < 300; ++i) {
      const Vector3d a(uniform(engine), uniform(engine), uniform(engine));
      const Vector3d b(uniform(engine), uniform(engine), uniform(engine));
      const Vector3d off(uniform(engine), uniform(engine), uniform(engine));
      const Vector3d c = a + 0.4 * (b - a) + thickness * off;
      const Vector3d q(uniform(engine), uniform(engine), uniform(engine));
      const TrianglePoint p = ClosestOnTriangle(a, b, c, q);
      EXPECT_GE(p.lambda.minCoeff(), 0.0);
      EXPECT_NEAR(p.lambda.sum(), 1.0, 1e-14);
      double sampled = std::numeric_limits<double>::infinity();
      for (int u = 0; u <= 60; ++u) {
        for (int v = 0; u + v <= 60; ++v) {
          sampled = std::min(
              sampled,
              (a + (b - a) * u / 60.0 + (c - a) * v / 60.0 - q).norm());
        }
      }
      const double distance = std::sqrt(p.squared_distance);
      EXPECT_LE(distance, sampled + 1e-14);
      EXPECT_GE(distance, sampled - 0.06);
      const Vector3d at = p.lambda[0] * a + p.lambda[1] * b + p.lambda[2] * c;
      EXPECT_NEAR((at - q).norm(), distance, 1e-14);
    }
  }
}

// A needle's normal has few correct digits: the foot of the perpendicular came
// out by up to half its width too far away, and points a grid step off the
// thin facets of contact spaces were taken for points in the clear.
TEST(ClosestOnTriangle, MeasuresBesideNeedles) {
  using Real = boost::multiprecision::cpp_bin_float_50;
  using Exact = Eigen::Matrix<Real, 3, 1>;
  std::mt19937 engine(12);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double width : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
    for (int i = 0; i < 300; ++i) {
      const auto random = [&]() -> Vector3d {
        return {uniform(engine), uniform(engine), uniform(engine)};
      };
      std::array<Vector3d, 3> t = {random(), random(), random()};
      t[2] = t[0] + 0.4 * (t[1] - t[0]) + width * random();
      const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
      const double off = width * uniform(engine);
      const Vector3d q = 0.3 * t[0] + 0.2 * t[1] + 0.5 * t[2] + off * normal;
      const auto exact = [](const Vector3d& v) -> Exact {
        return v.cast<Real>();
      };
      const Exact n = Exact(exact(t[1]) - exact(t[0]))
                          .cross(Exact(exact(t[2]) - exact(t[0])));
      const Real height =
          n.dot(Exact(exact(q) - exact(t[0]))) / sqrt(n.squaredNorm());
      std::rotate(t.begin(), t.begin() + i % 3, t.end());
      const TrianglePoint p = ClosestOnTriangle(t[0], t[1], t[2], q);
      EXPECT_NEAR(std::sqrt(p.squared_distance),
                  abs(height).convert_to<double>(), 2e-15)
          << width;
    }
  }
}

TEST(EuclideanMetric, RefusesWhatItCannotAnswer) {
  const TriangleMesh box = MakeBox({-1, -1, -1}, {1, 1, 1});
  const EuclideanMetric metric(TakeAsContactSpace(box));
  for (const double bad : {NAN, INFINITY, -INFINITY}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3d q = Vector3d::Zero();
      q[axis] = bad;
      const PenetrationResult result = metric.Query(q);
      EXPECT_EQ(result.status, QueryStatus::kInvalid);
      EXPECT_FALSE(result.inside);
      EXPECT_EQ(result.contact, Vector3d::Zero());
    }
  }
  for (const double far : {1e20, 1e100, 1e200, 1e300}) {
    const PenetrationResult result = metric.Query(Vector3d(0, far, 0));
    EXPECT_EQ(result.status, QueryStatus::kOk);
    EXPECT_NEAR(result.signed_distance / far, 1.0, 1e-14);
    EXPECT_LT((result.direction - Vector3d::UnitY()).norm(), 1e-12);
  }
  EXPECT_THROW(EuclideanMetric(TakeAsContactSpace(TriangleMesh{})), InputError);
  TriangleMesh open = box;
  open.triangles.pop_back();
  EXPECT_THROW(EuclideanMetric{TakeAsContactSpace(open)}, InputError);
  TriangleMesh broken = box;
  broken.vertices[0].x() = NAN;
  EXPECT_THROW(EuclideanMetric{TakeAsContactSpace(broken)}, InputError);
  broken = box;
  broken.triangles[0][0] = 99;
  EXPECT_THROW(EuclideanMetric{TakeAsContactSpace(broken)}, InputError);
}

}  // namespace
}  // namespace phongpd
