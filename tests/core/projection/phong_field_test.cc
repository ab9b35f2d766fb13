// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/phong_field.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "core/mesh/numbers.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::At;

struct NamedShape {
  std::string name;
  TriangleMesh mesh;
};

std::vector<NamedShape> Shapes() {
  const Eigen::Matrix3d turn = GenericRotation();
  return {{"box", MakeBox(Vector3d(0, 0, 0), Vector3d(1, 2, 3))},
          {"u", Rotated(MakeU(1.0, 0.1, 0.5), turn)},
          {"l", MakeL(1.0, 0.2, 0.3)},
          {"wrench", Rotated(MakeWrench(), turn)},
          {"cone", MakeCone(1.0, 2.0, 40)},
          {"star", Rotated(MakeStar(1.0, 2.0), turn)},
          {"vessel", MakeVessel(1.0, 0.8, 0.3)},
          {"plate", MakePlateWithHole(1.0, 0.02, 0.3)}};
}

PhongFieldOptions Ell(double ell) {
  PhongFieldOptions options;
  options.smoothing_length = ell;
  return options;
}

// Normals of the contact mesh's own triangles, by the definition.
Vector3d SourceNormal(const TriangleMesh& mesh, int t) {
  const Triangle& v = mesh.triangles[At(t)];
  return (mesh.vertices[At(v[1])] - mesh.vertices[At(v[0])])
      .cross(mesh.vertices[At(v[2])] - mesh.vertices[At(v[0])])
      .normalized();
}

double LeastDot(const PhongField& field, const TriangleMesh& contact) {
  double least = 1.0;
  for (std::size_t t = 0; t < field.mesh.triangles.size(); ++t) {
    const Vector3d facet = SourceNormal(contact, field.source_triangle[t]);
    for (const int v : field.mesh.triangles[t]) {
      least = std::min(least, facet.dot(field.normals[At(v)]));
    }
  }
  return least;
}

TEST(PhongField, IsAdmissibleForEverySmoothingLength) {
  for (const NamedShape& shape : Shapes()) {
    std::size_t limited = 0;
    for (const double ell : {0.0, 0.02, 0.1, 0.3, 1.0}) {
      SCOPED_TRACE(shape.name + ", ell " + std::to_string(ell));
      const PhongField field =
          BuildPhongField(TakeAsContactSpace(shape.mesh), Ell(ell));
      const double least = LeastDot(field, shape.mesh);
      EXPECT_GE(least, 0.1 - 1e-12);
      EXPECT_NEAR(field.report.min_normal_dot, least, 1e-12);
      EXPECT_EQ(field.report.inadmissible_vertices, 0u);
      EXPECT_EQ(field.report.obtuse_edges, 0u);
      limited += field.report.limited_vertices;
      double least_edge_dot = 1.0;
      double unit_error = 0.0;
      for (const Triangle& t : field.mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Vector3d& n = field.normals[At(t[k])];
          least_edge_dot = std::min(least_edge_dot,
                                    n.dot(field.normals[At(t[(k + 1) % 3])]));
          unit_error = std::max(unit_error, std::abs(n.norm() - 1.0));
        }
      }
      EXPECT_GT(least_edge_dot, 0.0);
      EXPECT_LT(unit_error, 1e-14);
    }
    // Thin shapes need the limiter, so that the test above means something.
    if (shape.name == "wrench" || shape.name == "plate") {
      EXPECT_GT(limited, 10u);
    }
  }
}

TEST(PhongField, NeedleTipGetsTheBestDirectionThereIs) {
  // n·N_f = sin(half opening angle) of the cone at best, less the facets'
  // sagitta: below the limiter, above zero.
  const TriangleMesh needle = MakeCone(0.05, 2.0, 40);
  const PhongField field =
      BuildPhongField(TakeAsContactSpace(needle), Ell(0.1));
  const double apothem = 0.05 * std::cos(kPi / 40.0);
  EXPECT_NEAR(LeastDot(field, needle), apothem / std::hypot(apothem, 2.0),
              1e-9);
  EXPECT_EQ(field.report.inadmissible_vertices, 0u);
  EXPECT_GT(field.report.limited_vertices, 0u);
  EXPECT_EQ(field.report.obtuse_edges, 0u);
}

// Two pyramids, tip to tip in one shared vertex.
TriangleMesh Pinched() {
  TriangleMesh mesh;
  mesh.vertices = {Vector3d(0, 0, 0)};
  for (const double z : {-1.0, 1.0}) {
    const int o = static_cast<int>(mesh.vertices.size());
    for (const double a : {0.0, 2.0, 4.0}) {
      mesh.vertices.push_back(Vector3d(std::cos(a), std::sin(a), z));
    }
    const auto face = [&](int i, int j, int k) {
      mesh.triangles.push_back(z < 0.0 ? Triangle{i, j, k} : Triangle{i, k, j});
    };
    face(0, o, o + 1);
    face(0, o + 1, o + 2);
    face(0, o + 2, o);
    face(o, o + 2, o + 1);
  }
  return mesh;
}

TEST(PhongField, InadmissibleVertexIsCountedAndConfined) {
  const TriangleMesh mesh = Pinched();
  ASSERT_GT(SignedVolume(mesh), 0.0);
  for (const double ell : {0.0, 0.2}) {
    const PhongField field =
        BuildPhongField(TakeAsContactSpace(mesh), Ell(ell));
    EXPECT_EQ(field.report.inadmissible_vertices, 1u);
    EXPECT_LE(field.report.min_normal_dot, 0.0);
    for (std::size_t t = 0; t < field.mesh.triangles.size(); ++t) {
      const Vector3d facet = SourceNormal(mesh, field.source_triangle[t]);
      for (const int v : field.mesh.triangles[t]) {
        const Vector3d q = field.FromField(field.mesh.vertices[At(v)]);
        if (facet.dot(field.normals[At(v)]) < 0.1 - 1e-12) {
          EXPECT_LE(q.norm(), std::sqrt(2.0) / 8.0 + 1e-12);
        }
      }
    }
  }
}

TEST(PhongField, SplittingKeepsTheSurface) {
  for (const NamedShape& shape : Shapes()) {
    SCOPED_TRACE(shape.name);
    PhongFieldOptions options = Ell(0.1);
    options.max_edge = 0.03;
    const PhongField field =
        BuildPhongField(TakeAsContactSpace(shape.mesh), options);
    ASSERT_GT(field.report.split_edges, 100u);
    const double scale = field.scale;
    const double volume = SignedVolume(shape.mesh) * scale * scale * scale;
    const double area = SurfaceArea(shape.mesh) * scale * scale;
    EXPECT_NEAR(SignedVolume(field.mesh), volume, 1e-14 * area);
    const double diagonal = ComputeBounds(field.mesh).Diagonal();
    EXPECT_GE(diagonal, 1.0);
    EXPECT_LT(diagonal, 2.0);
    std::map<int, long double> covered;  // so that the sums do not round
    long double total = 0.0L;
    for (std::size_t t = 0; t < field.mesh.triangles.size(); ++t) {
      const int source = field.source_triangle[t];
      const Vector3d facet = SourceNormal(shape.mesh, source);
      const Triangle& s = shape.mesh.triangles[At(source)];
      std::array<Vector3d, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d& q = field.mesh.vertices[At(field.mesh.triangles[t][k])];
        p[k] = q;
        // On the plane of its source and inside its three edges.
        for (std::size_t e = 0; e < 3; ++e) {
          const Vector3d a = field.ToField(shape.mesh.vertices[At(s[e])]);
          const Vector3d b =
              field.ToField(shape.mesh.vertices[At(s[(e + 1) % 3])]);
          EXPECT_NEAR((q - a).dot(facet), 0.0, 2e-15);
          EXPECT_GE(facet.dot((b - a).cross(q - a)), -4e-15);
        }
        EXPECT_LE(
            (q - field.mesh.vertices[At(field.mesh.triangles[t][(k + 1) % 3])])
                .norm(),
            0.03 * diagonal * (1.0 + 1e-12));
        const int n = field.neighbors[t][k];
        ASSERT_GE(n, 0);
      }
      const double part = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).dot(facet);
      covered[source] += part;
      total += part;
    }
    EXPECT_NEAR(static_cast<double>(total), area, 1e-14 * area);
    ASSERT_EQ(covered.size(), shape.mesh.triangles.size());
    for (const auto& [source, sum] : covered) {
      const Triangle& s = shape.mesh.triangles[At(source)];
      const double expected =
          0.5 * scale * scale *
          (shape.mesh.vertices[At(s[1])] - shape.mesh.vertices[At(s[0])])
              .cross(shape.mesh.vertices[At(s[2])] -
                     shape.mesh.vertices[At(s[0])])
              .norm();
      EXPECT_NEAR(static_cast<double>(sum), expected, 1e-14);
    }
  }
}

// The field as a set that does not know the order of vertices: for each
// triangle its three points and normals.
using Corner = std::array<double, 6>;
std::vector<std::array<Corner, 3>> AsSet(const PhongField& field) {
  std::vector<std::array<Corner, 3>> set;
  for (const Triangle& t : field.mesh.triangles) {
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& q = field.mesh.vertices[At(t[k])];
      const Vector3d& n = field.normals[At(t[k])];
      corners[k] = {q[0], q[1], q[2], n[0], n[1], n[2]};
    }
    std::rotate(corners.begin(),
                std::min_element(corners.begin(), corners.end()),
                corners.end());
    set.push_back(corners);
  }
  std::sort(set.begin(), set.end());
  return set;
}

TEST(PhongField, ScalingByAPowerOfTwoGivesTheSameBits) {
  for (const NamedShape& shape : Shapes()) {
    for (const double ell : {0.0, 0.1}) {
      const PhongField field =
          BuildPhongField(TakeAsContactSpace(shape.mesh), Ell(ell));
      for (const int k : {-40, -1, 3, 60}) {
        const double factor = std::ldexp(1.0, k);
        const PhongField scaled = BuildPhongField(
            TakeAsContactSpace(Scaled(shape.mesh, factor)), Ell(ell));
        ASSERT_EQ(field.mesh.triangles, scaled.mesh.triangles);
        ASSERT_EQ(field.source_triangle, scaled.source_triangle);
        ASSERT_EQ(field.scale, scaled.scale * factor);
        for (std::size_t v = 0; v < field.normals.size(); ++v) {
          ASSERT_EQ(field.normals[v], scaled.normals[v]) << shape.name;
          ASSERT_EQ(field.mesh.vertices[v], scaled.mesh.vertices[v]);
        }
      }
    }
  }
}

TEST(PhongField, DoesNotDependOnTheOrderOfTheInputToTheLastBit) {
  std::mt19937 rng(17);
  for (const NamedShape& shape : Shapes()) {
    for (const double ell : {0.0, 0.1}) {
      const auto expected =
          AsSet(BuildPhongField(TakeAsContactSpace(shape.mesh), Ell(ell)));
      TriangleMesh mesh = shape.mesh;
      std::vector<int> rank(mesh.vertices.size());
      for (std::size_t v = 0; v < rank.size(); ++v) {
        rank[v] = static_cast<int>(v);
      }
      std::shuffle(rank.begin(), rank.end(), rng);
      for (std::size_t v = 0; v < rank.size(); ++v) {
        mesh.vertices[At(rank[v])] = shape.mesh.vertices[v];
      }
      for (Triangle& t : mesh.triangles) {
        for (int& v : t) v = rank[At(v)];
        std::rotate(t.begin(), t.begin() + static_cast<int>(rng() % 3),
                    t.end());
      }
      std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), rng);
      mesh.vertices.push_back(Vector3d(100.0, 0.0, 0.0));  // unused
      const PhongField field =
          BuildPhongField(TakeAsContactSpace(mesh), Ell(ell));
      EXPECT_TRUE(AsSet(field) == expected) << shape.name << " " << ell;
      EXPECT_GE(LeastDot(field, mesh), 0.1 - 1e-12);  // sources are right
    }
  }
}

TEST(PhongField, SmoothFieldBelongsToTheShapeAndNotToTheMesh) {
  // The same box from 12 and from thousands of triangles: normals at the
  // common vertices agree once edges are ≤ ℓ/2, and do not without splitting.
  const TriangleMesh box = MakeBox(Vector3d(0, 0, 0), Vector3d(1, 2, 3));
  PhongFieldOptions fine = Ell(0.2);
  fine.max_edge = 0.02;
  const PhongField reference = BuildPhongField(TakeAsContactSpace(box), fine);
  std::map<std::array<double, 3>, Vector3d> normal_at;
  for (std::size_t v = 0; v < reference.normals.size(); ++v) {
    const Vector3d& q = reference.mesh.vertices[v];
    normal_at[{q[0], q[1], q[2]}] = reference.normals[v];
  }
  const auto worst = [&](double max_edge) {
    PhongFieldOptions options = Ell(0.2);
    options.max_edge = max_edge;
    const PhongField field = BuildPhongField(TakeAsContactSpace(box), options);
    double angle = 0.0;
    std::size_t common = 0;
    for (std::size_t v = 0; v < field.normals.size(); ++v) {
      const Vector3d& q = field.mesh.vertices[v];
      const auto it = normal_at.find({q[0], q[1], q[2]});
      if (it == normal_at.end()) continue;
      ++common;
      angle = std::max(angle, (it->second - field.normals[v]).norm());
    }
    EXPECT_GE(common, 8u);
    return angle;
  };
  EXPECT_LT(worst(0.0), 0.03);
  EXPECT_GT(worst(1.0), 0.2);
}

TEST(PhongField, PaperFieldOfABallNeedsNothing) {
  const TriangleMesh ball = MakeIcoBall(1.0, 3);
  const PhongField field = BuildPhongField(TakeAsContactSpace(ball),
                                           PhongFieldOptions::Unsmoothed());
  EXPECT_EQ(field.mesh.triangles.size(), ball.triangles.size());
  EXPECT_EQ(field.report.split_edges, 0u);
  EXPECT_EQ(field.report.limited_vertices, 0u);
  for (std::size_t v = 0; v < field.normals.size(); ++v) {
    const Vector3d radial =
        field.FromField(field.mesh.vertices[v]).normalized();
    EXPECT_LT((field.normals[v] - radial).norm(), 0.01);
  }
}

TEST(PhongField, DegenerateTrianglesDoNoHarm) {
  // A sliver of altitude 0 in a box edge, with a vertex that has no other
  // facets than degenerate ones.
  TriangleMesh mesh = MakeBox(Vector3d(0, 0, 0), Vector3d(1, 1, 1));
  const Triangle t = mesh.triangles[0];
  const int a = t[0], b = t[1], c = t[2];
  const int m = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (mesh.vertices[At(a)] + mesh.vertices[At(b)]));
  mesh.vertices.push_back(0.75 * mesh.vertices[At(a)] +
                          0.25 * mesh.vertices[At(b)]);
  mesh.triangles[0] = {a, m, c};
  mesh.triangles.push_back({m, b, c});
  mesh.triangles.push_back({a, b, m + 1});
  mesh.triangles.push_back({b, m, m + 1});
  mesh.triangles.push_back({m, a, m + 1});
  for (const double ell : {0.0, 0.1}) {
    const PhongField field =
        BuildPhongField(TakeAsContactSpace(mesh), Ell(ell));
    EXPECT_EQ(field.report.obtuse_edges, 0u);
    EXPECT_GT(field.report.min_normal_dot, 0.1 - 1e-12);
    for (const Vector3d& n : field.normals) {
      EXPECT_NEAR(n.norm(), 1.0, 1e-14);
    }
  }
}

TEST(PhongField, RefusesBadInputByName) {
  const TriangleMesh box = MakeBox(Vector3d(0, 0, 0), Vector3d(1, 1, 1));
  const auto message = [](const TriangleMesh& mesh,
                          const PhongFieldOptions& options) -> std::string {
    return testing::ErrorOf(
        [&] { BuildPhongField(TakeAsContactSpace(mesh), options); },
        "accepted");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(box, Ell(-0.1)).find("smoothing_length"),
            std::string::npos);
  EXPECT_NE(message(box, Ell(nan)).find("smoothing_length"), std::string::npos);
  PhongFieldOptions options;
  options.max_edge = 1e-5;
  EXPECT_NE(message(box, options).find("max_edge"), std::string::npos);
  TriangleMesh open = box;
  open.triangles.pop_back();
  EXPECT_NE(message(open, {}).find("3 half-edges without exactly one opposite"),
            std::string::npos);
  TriangleMesh bad = box;
  bad.vertices[0].x() = nan;
  EXPECT_NE(message(bad, {}).find("finite"), std::string::npos);
  EXPECT_NE(message(TriangleMesh(), {}).find("no triangle"), std::string::npos);
  EXPECT_NE(message(Scaled(box, 0.0), {}).find("diagonal"), std::string::npos);
}

}  // namespace
}  // namespace phongpd
