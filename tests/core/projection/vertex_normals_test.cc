// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/vertex_normals.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/mesh/numbers.h"
#include "core/projection/intrinsic_delaunay.h"
#include "core/projection/normal_cone.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::At;

// A box whose flat faces are cut at random: each face is a fan around a random
// inner point, so facets have arbitrary shapes.
TriangleMesh FannedBox(unsigned seed) {
  const TriangleMesh box = MakeBox(Vector3d(-1, -2, -3), Vector3d(1, 2, 3));
  TriangleMesh result;
  result.vertices = box.vertices;
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> unit(0.05, 0.9);
  for (const Triangle& t : box.triangles) {
    Vector3d l(unit(rng), unit(rng), unit(rng));
    l /= l.sum();
    const int m = static_cast<int>(result.vertices.size());
    result.vertices.push_back(l[0] * box.vertices[At(t[0])] +
                              l[1] * box.vertices[At(t[1])] +
                              l[2] * box.vertices[At(t[2])]);
    result.triangles.push_back({t[0], t[1], m});
    result.triangles.push_back({t[1], t[2], m});
    result.triangles.push_back({t[2], t[0], m});
  }
  return result;
}

std::vector<Vector3d> Normals(const TriangleMesh& mesh) {
  return VertexNormals(mesh, FacetNormals(mesh));
}

// The paper's: facets count alike.
std::vector<Vector3d> PlainAverages(const TriangleMesh& mesh) {
  const std::vector<Vector3d> facets = FacetNormals(mesh);
  std::vector<Vector3d> sums(mesh.vertices.size(), Vector3d::Zero());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const int v : mesh.triangles[f]) sums[At(v)] += facets[f];
  }
  for (Vector3d& sum : sums) sum.normalize();
  return sums;
}

TEST(FacetNormals, AreUnitAndOrthogonalToTheEdges) {
  const TriangleMesh mesh = Rotated(MakeWrench(), GenericRotation());
  const auto normals = FacetNormals(mesh);
  for (std::size_t f = 0; f < normals.size(); ++f) {
    EXPECT_NEAR(normals[f].norm(), 1.0, 1e-15);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d edge = mesh.vertices[At(mesh.triangles[f][(k + 1) % 3])] -
                            mesh.vertices[At(mesh.triangles[f][k])];
      EXPECT_NEAR(normals[f].dot(edge), 0.0, 1e-13);
    }
  }
}

TEST(FacetNormals, SliversKeepTheirDirectionAndDegenerateOnesGetZero) {
  // Altitudes 1e-6 and 1e-15 on a base of length 2, in a tilted plane.
  const Eigen::Matrix3d turn = GenericRotation();
  for (const double altitude : {1e-2, 1e-6, 1e-15}) {
    TriangleMesh mesh;
    mesh.vertices = {Vector3d(-1, 0, 0), Vector3d(1, 0, 0),
                     Vector3d(0.3, altitude, 0)};
    mesh.triangles = {{0, 1, 2}};
    const Vector3d n = FacetNormals(Rotated(mesh, turn))[0];
    if (altitude < 1e-12) {
      EXPECT_TRUE(n.isZero(0.0));
    } else {
      EXPECT_LT((n - turn.col(2)).norm(), 4e-16 / altitude + 1e-15);
    }
  }
}

TEST(VertexNormals, BoxCornersPointAlongTheDiagonals) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const TriangleMesh mesh = FannedBox(seed);
    const auto normals = Normals(mesh);
    for (std::size_t v = 0; v < 8; ++v) {
      const Vector3d expected = mesh.vertices[v].cwiseSign() / std::sqrt(3.0);
      EXPECT_LT((normals[v] - expected).norm(), 1e-14) << "seed " << seed;
    }
  }
}

TEST(VertexNormals, PlainAverageDependsOnTriangulationAndAnglesDoNot) {
  const TriangleMesh box = MakeBox(Vector3d(-1, -2, -3), Vector3d(1, 2, 3));
  const TriangleMesh fan = FannedBox(7);
  double uniform = 0.0;
  double angle = 0.0;
  const auto u = PlainAverages(box);
  const auto v = PlainAverages(fan);
  const auto a = Normals(box);
  const auto b = Normals(fan);
  for (std::size_t k = 0; k < 8; ++k) {
    uniform = std::max(uniform, (u[k] - v[k]).norm());
    angle = std::max(angle, (a[k] - b[k]).norm());
  }
  EXPECT_LT(angle, 1e-14);
  // A box's own diagonals make the plain average lopsided; a fan around each
  // triangle doubles the facets at every corner and changes nothing.  A split
  // on one side only does.
  EXPECT_LT(uniform, 1e-14);
  double lopsided = 0.0;
  for (std::size_t k = 0; k < 8; ++k) {
    lopsided = std::max(lopsided, (u[k] - a[k]).norm());
  }
  EXPECT_GT(lopsided, 0.1);
}

TEST(VertexNormals, BallNormalsAreRadial) {
  // By symmetry exact at the icosahedron's 12 vertices; first order where its
  // edges were, because facets on their two sides differ in shape.
  double previous = 0.0;
  for (const int levels : {2, 3, 4}) {
    const TriangleMesh ball = MakeIcoBall(2.0, levels);
    const auto normals = Normals(ball);
    double worst = 0.0;
    for (std::size_t v = 0; v < normals.size(); ++v) {
      const double error = (normals[v] - ball.vertices[v] / 2.0).norm();
      worst = std::max(worst, error);
      if (v < 12) {
        EXPECT_LT(error, 1e-14);
      }
    }
    EXPECT_LT(worst, 0.02);
    if (previous > 0.0) {
      EXPECT_LT(worst, 0.55 * previous);
    }
    previous = worst;
  }
}

TEST(VertexNormals, DoNotDependOnTheOrderOfTrianglesToTheLastBit) {
  TriangleMesh mesh = Rotated(MakeWrench(), GenericRotation());
  const auto expected = Normals(mesh);
  std::mt19937 rng(5);
  for (int round = 0; round < 5; ++round) {
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), rng);
    for (Triangle& t : mesh.triangles) {
      std::rotate(t.begin(), t.begin() + static_cast<int>(rng() % 3), t.end());
    }
    const auto normals = Normals(mesh);
    for (std::size_t v = 0; v < normals.size(); ++v) {
      ASSERT_EQ(normals[v], expected[v]);
    }
  }
}

TEST(IntrinsicDelaunay, WeightsAreNonNegativeAndKnowThePlane) {
  // In the plane the cotangent Laplacian of any triangulation reproduces
  // linear functions; inner points of the box's faces see only their plane.
  for (const unsigned seed : {1u, 2u}) {
    const TriangleMesh mesh = FannedBox(seed);
    for (const CotangentWeight& w : IntrinsicDelaunayWeights(mesh)) {
      EXPECT_GE(w.weight, 0.0);
    }
  }
  // Total Dirichlet energy of x on a unit tetrahedron-like closed surface is
  // Σ A_f |∇_f x|²: true of the given triangulation, and a Delaunay flip can
  // only lower it (Rippa), never below zero.
  const TriangleMesh mesh = Rotated(FannedBox(3), GenericRotation());
  double energy = 0.0;
  for (const CotangentWeight& w : IntrinsicDelaunayWeights(mesh)) {
    const double d = mesh.vertices[At(w.i)].x() - mesh.vertices[At(w.j)].x();
    energy += w.weight * d * d;
  }
  double expected = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d cross =
        (mesh.vertices[At(t[1])] - mesh.vertices[At(t[0])])
            .cross(mesh.vertices[At(t[2])] - mesh.vertices[At(t[0])]);
    const double nx = cross.x() / cross.norm();
    expected += 0.5 * cross.norm() * (1.0 - nx * nx);
  }
  EXPECT_LE(energy, expected * (1.0 + 1e-8));
  EXPECT_GT(energy, 0.5 * expected);
}

TEST(DiffuseNormals, AgreesWithADenseSolveOnADelaunayMesh) {
  // A fine ball is Delaunay as it stands, so the textbook matrices apply.
  const TriangleMesh mesh = MakeIcoBall(1.0, 2);
  const auto facets = FacetNormals(mesh);
  const auto n0 = VertexNormals(mesh, facets);
  const double ell = 0.4;
  const auto n = static_cast<Eigen::Index>(mesh.vertices.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(n, 3);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = t[k], j = t[(k + 1) % 3], o = t[(k + 2) % 3];
      const Vector3d a = mesh.vertices[At(i)] - mesh.vertices[At(o)];
      const Vector3d b = mesh.vertices[At(j)] - mesh.vertices[At(o)];
      const double area = 0.5 * a.cross(b).norm();
      const double w = 0.5 * ell * ell * a.dot(b) / a.cross(b).norm();
      matrix(i, i) += w + area / 3.0;
      matrix(j, j) += w;
      matrix(i, j) -= w;
      matrix(j, i) -= w;
      load.row(i) += area / 3.0 * n0[At(i)].transpose();
    }
  }
  const Eigen::MatrixXd expected = matrix.partialPivLu().solve(load);
  const auto smooth = DiffuseNormals(mesh, n0, ell);
  for (Eigen::Index i = 0; i < n; ++i) {
    EXPECT_LT(
        (smooth[static_cast<std::size_t>(i)].transpose() - expected.row(i))
            .norm(),
        1e-7);  // mollification moves lengths by 1e-10 relative
  }
}

TEST(DiffuseNormals, DecaysAsTheFirstHarmonicOnASphere) {
  const double r = 1.5;
  for (const double ell : {0.1, 0.5, 2.0}) {
    const double expected = 1.0 / (1.0 + 2.0 * ell * ell / (r * r));
    double previous = 0.0;
    for (const int m : {24, 48, 96}) {
      const TriangleMesh ball = MakeUvBall(r, m, m);
      std::vector<Vector3d> radial;
      for (const Vector3d& v : ball.vertices) radial.push_back(v / r);
      const auto smooth = DiffuseNormals(ball, radial, ell);
      double worst = 0.0;
      for (std::size_t v = 0; v < smooth.size(); ++v) {
        worst = std::max(worst, (smooth[v] - expected * radial[v]).norm());
      }
      // The lumped mass is first order at the poles; second order elsewhere.
      EXPECT_LT(worst, 0.1 * expected) << "ell " << ell << ", m " << m;
      if (previous > 0.0) {
        EXPECT_LT(worst, 0.75 * previous);
      }
      previous = worst;
    }
  }
}

TEST(DiffuseNormals, KeepsConstantsAndTheMaximumPrincipleOnSlivers) {
  // A box face cut into slivers of aspect 1e6.
  TriangleMesh mesh = MakeBox(Vector3d(0, 0, 0), Vector3d(1, 1, 1));
  const Triangle t = mesh.triangles[0];
  const Vector3d middle =
      0.5 * (mesh.vertices[At(t[0])] + mesh.vertices[At(t[1])]);
  const Vector3d inside = middle + 1e-6 * (mesh.vertices[At(t[2])] - middle);
  const int m = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(inside);
  mesh.triangles[0] = {t[0], t[1], m};
  mesh.triangles.push_back({t[1], t[2], m});
  mesh.triangles.push_back({t[2], t[0], m});
  const std::vector<Vector3d> constant(mesh.vertices.size(),
                                       Vector3d(0.1, -0.2, 0.7));
  for (const Vector3d& n : DiffuseNormals(mesh, constant, 0.3)) {
    EXPECT_LT((n - constant[0]).norm(), 1e-12);
  }
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vector3d> noise;
  Vector3d low = Vector3d::Constant(2.0), high = -low;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    noise.emplace_back(unit(rng), unit(rng), unit(rng));
    low = low.cwiseMin(noise.back());
    high = high.cwiseMax(noise.back());
  }
  for (const double ell : {1e-3, 0.1, 10.0}) {
    for (const Vector3d& n : DiffuseNormals(mesh, noise, ell)) {
      EXPECT_TRUE((n.array() >= low.array() - 1e-12).all());
      EXPECT_TRUE((n.array() <= high.array() + 1e-12).all());
    }
  }
}

TEST(MeanNormals, AreTheAreaMeansOfTheFacets) {
  const TriangleMesh cube = FannedBox(4);
  const auto facets = FacetNormals(cube);
  const auto mean = MeanNormals(cube, facets);
  for (std::size_t v = 0; v < cube.vertices.size(); ++v) {
    Vector3d sum = Vector3d::Zero();
    double total = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const Triangle& t = cube.triangles[f];
      if (std::find(t.begin(), t.end(), static_cast<int>(v)) == t.end()) {
        continue;
      }
      const Vector3d a = cube.vertices[At(t[0])];
      const double area = (cube.vertices[At(t[1])] - a)
                              .cross(cube.vertices[At(t[2])] - a)
                              .norm();
      sum += area * facets[f];
      total += area;
    }
    EXPECT_LT((mean[v] - sum / total).norm(), 1e-14);
  }
}

TEST(BestNormal, BeatsEveryDirectionOfADenseSample) {
  std::mt19937 rng(3);
  std::normal_distribution<double> gauss;
  int feasible = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Vector3d> facets;
    const double lift = 0.25 * (round % 8);
    for (int f = 0; f < 3 + round % 9; ++f) {
      facets.push_back(
          Vector3d(gauss(rng), gauss(rng), gauss(rng) + lift).normalized());
    }
    double sampled = -1.0;
    for (int k = 0; k < 20000; ++k) {
      const Vector3d n =
          Vector3d(gauss(rng), gauss(rng), gauss(rng)).normalized();
      sampled = std::max(sampled, MinFacetDot(n, facets));
    }
    const Vector3d best = BestNormal(facets);
    if (best.isZero(0.0)) {
      EXPECT_LE(sampled, 1e-9);
    } else {
      ++feasible;
      EXPECT_GE(MinFacetDot(best, facets), sampled - 1e-12);
      EXPECT_LE(MinFacetDot(best, facets), sampled + 0.05);
    }
  }
  EXPECT_GT(feasible, 10);
  EXPECT_LT(feasible, 55);
}

TEST(LimitNormal, StopsOnTheBoundaryOfTheCone) {
  const std::vector<Vector3d> facets = {Vector3d::UnitX(), Vector3d::UnitY(),
                                        Vector3d::UnitZ()};
  const Vector3d base = Vector3d::Ones().normalized();
  const Vector3d n = Vector3d(1.0, 0.5, -0.8).normalized();
  const Vector3d limited = LimitNormal(n, base, facets, 0.1);
  EXPECT_NEAR(MinFacetDot(limited, facets), 0.1, 1e-14);
  EXPECT_GE(MinFacetDot(limited, facets), 0.1);
  EXPECT_NEAR(limited.dot(n.cross(base)), 0.0, 1e-14);  // on the great circle
  EXPECT_EQ(LimitNormal(base, n, facets, 0.1), base);   // nothing to do
}

}  // namespace
}  // namespace phongpd
