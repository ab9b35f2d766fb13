// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/shapes/shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "core/pi.h"
#include "core/solid/solid.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/random_vector.h"
#include "tests/support/expect_refused.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::PolygonArea;

const double kNaN = std::numeric_limits<double>::quiet_NaN();

double UvBallVolume(double radius, int meridians, int parallels) {
  double volume = 0;
  for (int i = 0; i < parallels; ++i) {
    const double upper = kPi * i / parallels, lower = kPi * (i + 1) / parallels;
    const double r = std::sin(upper), s = std::sin(lower);
    volume += (std::cos(upper) - std::cos(lower)) * (r * r + r * s + s * s) / 3;
  }
  return volume * PolygonArea(meridians, 1.0) * std::pow(radius, 3);
}

// Sections at constant z are polygonal rings; Pappus for the profile.
double TorusVolume(double major, double minor, int around, int across) {
  return around * std::sin(2 * kPi / around) * major *
         PolygonArea(across, minor);
}

double StarVolume(double inner, double outer) {
  const double edge = inner / std::sin(2 * kPi / 5);
  return 20 * (std::sqrt(3.0) / 4 * edge * edge) * outer / 3;
}

// Outline by fans around the centres of ring and jaw, minus throat and hole.
double WrenchVolume(int hole, int ring, int jaw, int throat) {
  const double r = 1, w = 0.35, j = 1.2, gap = 0.55;
  const double a = std::asin(w / r), b = std::asin(w / j);
  const double g = std::asin(gap / j);
  const auto fan = [](double radius, double angle, int points) {
    return 0.5 * (points - 1) * radius * radius *
           std::sin(angle / (points - 1));
  };
  const double handle = w * r * std::cos(a) + w * j * std::cos(b) +
                        2 * w * (5 - r * std::cos(a) - j * std::cos(b));
  const double slot =
      gap * (j * std::cos(g) + 0.1) + 0.1 * gap + fan(gap, kPi, throat);
  return 0.5 * (fan(r, 2 * kPi - 2 * a, ring) + handle +
                2 * fan(j, kPi - b - g, jaw) - slot - PolygonArea(hole, 0.6));
}

struct Expectation {
  std::string name;
  TriangleMesh mesh;
  std::size_t triangles;
  int euler;  // V − E + F = Σ over shells of 2 − 2·genus
  double volume;
};

std::vector<Expectation> Shapes() {
  const double ico = StarVolume(1, std::sqrt((5 + 2 * std::sqrt(5.0)) / 15));
  return {
      {"icosahedron", MakeIcoBall(1, 0), 20, 2, ico},
      {"ball", MakeUvBall(1, 24, 22), 1008, 2, UvBallVolume(1, 24, 22)},
      {"tiny", MakeUvBall(1e-9, 9, 7), 108, 2, UvBallVolume(1e-9, 9, 7)},
      {"octahedron", MakeUvBall(3, 4, 2), 8, 2, 36},
      {"cone", MakeCone(0.8, 1.6, 40), 78, 2, PolygonArea(40, 0.8) * 1.6 / 3},
      {"box", MakeBox({1, 2, 3}, {2, 4, 6}), 12, 2, 6},
      {"axes", MakeAxes(2, 0.2), 60, 2, 3 * 4 * 0.16 - 2 * 0.064},
      {"wrench", MakeWrench(), 772, 0, WrenchVolume(48, 45, 35, 30)},
      {"small wrench", MakeWrench(0.5, 12, 12, 8, 8), 192, 0,
       WrenchVolume(12, 12, 8, 8) / 8},
      {"coarsest wrench", MakeWrench(1, 3, 6, 4, 3), 80, 0,
       WrenchVolume(3, 6, 4, 3)},
      {"torus", MakeTorus(2, 0.6, 24, 12), 576, 0, TorusVolume(2, 0.6, 24, 12)},
      {"fat torus", MakeTorus(1, 0.999, 3, 3), 18, 0,
       TorusVolume(1, 0.999, 3, 3)},
      {"L", MakeL(2, 0.5, 3), 20, 2, (4 - 2.25) * 3},
      {"U", MakeU(2, 0.25, 3), 28, 2, (4 - 1.75 * 1.5) * 3},
      {"plate", MakePlateWithHole(4, 1, 1), 32, 0, 15},
      {"round plate", MakePlateWithRoundHole(4, 1, 0.52, 32), 144, 0,
       16 - PolygonArea(32, 0.52)},
      {"peg", MakePrism(0.5, 2, 32), 124, 2, 2 * PolygonArea(32, 0.5)},
      {"shell", MakeVessel(4, 3, 0), 24, 4, 64 - 27},
      {"vessel", MakeVessel(3.6, 3, 0.6), 412, 2,
       std::pow(3.6, 3) - 27 - 0.36 * 0.3},
      {"star", MakeStar(0.5, 1.2), 60, 2, StarVolume(0.5, 1.2)},
      {"dented star", MakeStar(1, 0.2), 60, 2, StarVolume(1, 0.2)},
  };
}

TEST(Shapes, AreSolidsOfTheirClosedFormVolume) {
  for (const Expectation& shape : Shapes()) {
    SCOPED_TRACE(shape.name);
    EXPECT_EQ(shape.mesh.triangles.size(), shape.triangles);
    std::set<std::pair<int, int>> edges;
    for (const Triangle& t : shape.mesh.triangles) {
      for (int k = 0; k < 3; ++k)
        edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }
    EXPECT_EQ(static_cast<int>(shape.mesh.vertices.size() +
                               shape.mesh.triangles.size() - edges.size()),
              shape.euler);
    EXPECT_NEAR(SignedVolume(shape.mesh) / shape.volume, 1, 1e-13);
    MeshReport report;
    const TriangleMesh solid = MakeSolid(shape.mesh, shape.name, &report);
    EXPECT_EQ(solid.triangles, shape.mesh.triangles);
    EXPECT_EQ(report.vertices, shape.mesh.vertices.size());
    EXPECT_TRUE(report.warnings.empty());
  }
}

TEST(Shapes, RotatedGenericallyStaySolids) {
  for (const Expectation& shape : Shapes()) {
    MeshReport report;
    MakeSolid(Rotated(shape.mesh, GenericRotation()), shape.name, &report);
    EXPECT_NEAR(report.volume / shape.volume, 1, 1e-12) << shape.name;
  }
}

TEST(Shapes, AreTheSameBytesEveryTime) {
  const std::vector<Expectation> once = Shapes(), again = Shapes();
  for (std::size_t i = 0; i < once.size(); ++i) {
    const TriangleMesh &a = once[i].mesh, &b = again[i].mesh;
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    EXPECT_EQ(std::memcmp(a.vertices.data(), b.vertices.data(),
                          a.vertices.size() * sizeof(Vector3d)),
              0);
    EXPECT_EQ(a.triangles, b.triangles);
  }
}

TEST(Shapes, HitTheAxesExactly) {
  for (const TriangleMesh& mesh :
       {MakeUvBall(0.7, 24, 22), MakePrism(0.7, 1.4, 32),
        MakeCone(0.7, 0.7, 40), MakeTorus(0.5, 0.2, 24, 12)}) {
    const BoundingBox box = ComputeBounds(mesh);
    EXPECT_EQ(box.max.x(), 0.7);
    EXPECT_EQ(box.min.x(), -0.7);
    EXPECT_EQ(box.max.y(), 0.7);
    EXPECT_EQ(box.min.y(), -0.7);
  }
  const BoundingBox box = ComputeBounds(MakeBox({0.1, 0.2, 0.3}, {0.7, 1, 3}));
  EXPECT_EQ(box.min, Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(box.max, Vector3d(0.7, 1, 3));
}

TEST(Blob, IsABumpySolidOfItsSeed) {
  const TriangleMesh ball = MakeIcoBall(2, 4);
  EXPECT_EQ(MakeBlob(2, 4, 0.0, 1).vertices, ball.vertices);
  const TriangleMesh blob = MakeBlob(2, 4, 0.35, 1);
  EXPECT_EQ(blob.triangles, ball.triangles);
  EXPECT_EQ(blob.triangles.size(), 5120u);
  EXPECT_EQ(blob.vertices, MakeBlob(2, 4, 0.35, 1).vertices);
  EXPECT_NE(blob.vertices, MakeBlob(2, 4, 0.35, 2).vertices);
  double low = 4, high = 0;
  for (std::size_t i = 0; i < blob.vertices.size(); ++i) {
    const double radius = blob.vertices[i].norm();
    low = std::min(low, radius);
    high = std::max(high, radius);
    EXPECT_NEAR(blob.vertices[i].dot(ball.vertices[i]), 2 * radius, 1e-14);
  }
  EXPECT_GT(low, 2 * 0.65);
  EXPECT_LT(low, 2 * 0.85);
  EXPECT_LT(high, 2 * 1.35);
  EXPECT_GT(high, 2 * 1.15);
  MeshReport report;
  MakeSolid(MakeBlob(1e-9, 3, 0.99, 5), "blob", &report);
  EXPECT_EQ(report.inverted_components, 0);
}

TEST(Scan, IsTheSolidWithShortEdgesAndSmallNoise) {
  const TriangleMesh u = MakeU(2.0, 0.2, 1.0);
  const double edge = 0.15;
  const TriangleMesh fine = MakeScan(u, edge, 0.0, 1);
  EXPECT_NEAR(SignedVolume(fine), SignedVolume(u), 1e-13);
  EXPECT_GT(fine.triangles.size(), 10 * u.triangles.size());
  const double noise = 0.01 * edge;
  const TriangleMesh scan = MakeScan(u, edge, noise, 1);
  EXPECT_EQ(scan.triangles, fine.triangles);
  EXPECT_EQ(scan.vertices, MakeScan(u, edge, noise, 1).vertices);
  EXPECT_NE(scan.vertices, MakeScan(u, edge, noise, 2).vertices);
  double moved = 0.0, longest = 0.0;
  for (std::size_t i = 0; i < scan.vertices.size(); ++i) {
    const Vector3d off = scan.vertices[i] - fine.vertices[i];
    moved = std::max(moved, off.cwiseAbs().maxCoeff());
  }
  EXPECT_LE(moved, noise);
  EXPECT_GT(moved, 0.95 * noise);
  for (const Triangle& t : fine.triangles) {
    for (int k = 0; k < 3; ++k) {
      longest = std::max(
          longest,
          (fine.vertices[t[k]] - fine.vertices[t[(k + 1) % 3]]).norm());
    }
  }
  EXPECT_LE(longest, edge);
  // Closed, embedded, outward; no two neighbours coplanar.
  MeshReport report;
  MakeSolid(scan, "scan", &report);
  EXPECT_EQ(report.inverted_components, 0);
  EXPECT_THROW(MakeScan(u, edge, 0.02, 1), InputError);
  EXPECT_THROW(MakeScan(u, 0.0, 0.0, 1), InputError);
  EXPECT_THROW(MakeScan(u, 1e-6, 0.0, 1), InputError);
}

TEST(IcoBall, ConvergesToTheBallByAFactorOfFourALevel) {
  const double ball = 4.0 / 3.0 * kPi;
  double last = ball - SignedVolume(MakeIcoBall(1, 1));
  for (int level = 2; level <= 5; ++level) {
    const TriangleMesh mesh = MakeIcoBall(1, level);
    EXPECT_EQ(mesh.triangles.size(), 20u << (2 * level));
    const double gap = ball - SignedVolume(mesh);
    EXPECT_NEAR(last / gap, 4, 0.3);
    last = gap;
  }
}

TEST(Knot, IsASolidTubeAlongItsCurve) {
  // Length of the curve by its derivative, on another sampling.
  double length = 0;
  for (int i = 0; i < 100000; ++i) {
    const double t = 2 * kPi * i / 100000;
    length += std::sqrt(std::pow(std::cos(t) + 4 * std::cos(2 * t), 2) +
                        std::pow(4 * std::sin(2 * t) - std::sin(t), 2) +
                        std::pow(3 * std::cos(3 * t), 2)) *
              2 * kPi / 100000;
  }
  for (const int around : {32, 64, 1000}) {
    for (const int across : {3, 8}) {
      MeshReport report;
      MakeSolid(MakeKnot(2, 0.99, around, across), "knot", &report);
      EXPECT_EQ(report.inverted_components, 0);
      EXPECT_EQ(report.triangles, 2u * around * across);
      if (around < 1000) continue;
      EXPECT_NEAR(report.volume / (2 * length * PolygonArea(across, 0.99)), 1,
                  1e-3);
    }
  }
}

TEST(Joined, KeepsBothMeshesAsTheyAre) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  const TriangleMesh both = Joined(box, MakeStar(1, 2));
  EXPECT_EQ(both.vertices.size(), 8u + 32u);
  EXPECT_EQ(both.triangles.size(), 12u + 60u);
  EXPECT_NEAR(ExamineMesh(both).volume, 1 + StarVolume(1, 2), 1e-13);
  EXPECT_EQ(Joined(box, TriangleMesh{}).triangles, box.triangles);
}

TEST(GenericRotation, IsARotation) {
  const Eigen::Matrix3d r = GenericRotation();
  EXPECT_NEAR((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 0,
              1e-15);
  EXPECT_NEAR(r.determinant(), 1, 1e-15);
  EXPECT_GT(r.cwiseAbs().minCoeff(), 0.0);
}

// Two counts within their range made 2·10⁸ triangles.
TEST(Shapes, RefuseMoreThanTenMillionTriangles) {
  const auto refusal = [](const std::function<void()>& make) -> std::string {
    return testing::ErrorOf([&] { make(); }, "accepted");
  };
  EXPECT_EQ(refusal([] { MakeUvBall(1, 10000, 502); }),
            "MakeUvBall: 2·meridians·(parallels - 1) triangles must be a count "
            "in [0, 10000000], found 10020000");
  EXPECT_EQ(refusal([] { MakeTorus(2, 1, 10000, 10000); }),
            "MakeTorus: 2·around·across triangles must be a count in [0, "
            "10000000], found 200000000");
  EXPECT_EQ(refusal([] { MakeKnot(2, 0.5, 2501, 2000); }),
            "MakeKnot: 2·around·across triangles must be a count in [0, "
            "10000000], found 10004000");
  EXPECT_EQ(MakeTorus(2, 1, 10000, 50).triangles.size(), 1000000u);
}

TEST(Shapes, RefuseBadParametersByName) {
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<std::string, std::function<void()>>> refused = {
      {"MakeIcoBall: radius", [] { MakeIcoBall(0, 1); }},
      {"MakeIcoBall: levels", [] { MakeIcoBall(1, -1); }},
      {"MakeIcoBall: levels", [] { MakeIcoBall(1, 10); }},
      {"MakeUvBall: radius", [] { MakeUvBall(kNaN, 8, 8); }},
      {"MakeUvBall: meridians", [] { MakeUvBall(1, 2, 8); }},
      {"MakeUvBall: parallels", [] { MakeUvBall(1, 8, 1); }},
      {"MakeUvBall: meridians", [] { MakeUvBall(1, 2000000000, 8); }},
      {"MakeCone: radius", [] { MakeCone(-1, 1, 8); }},
      {"MakeCone: height", [=] { MakeCone(1, inf, 8); }},
      {"MakeCone: height", [] { MakeCone(1, 1e-320, 8); }},
      {"MakeCone: sides", [] { MakeCone(1, 1, 2); }},
      {"MakeBox: max - min",
       [] {
         MakeBox({0, 0, 0}, {1, 0, 1});
       }},
      {"MakeBox: max - min",
       [] {
         MakeBox({0, kNaN, 0}, {1, 1, 1});
       }},
      {"MakeBox: max - min",
       [=] {
         MakeBox({-inf, 0, 0}, {inf, 1, 1});
       }},
      {"MakeAxes: half_width", [] { MakeAxes(1, 1); }},
      {"MakeWrench: scale", [] { MakeWrench(0); }},
      {"MakeWrench: hole", [] { MakeWrench(1, 2); }},
      {"MakeWrench: ring", [] { MakeWrench(1, 8, 5); }},
      {"MakeWrench: jaw", [] { MakeWrench(1, 8, 8, 3); }},
      {"MakeWrench: throat", [] { MakeWrench(1, 8, 8, 8, 2); }},
      {"MakeTorus: minor_radius", [] { MakeTorus(1, 1, 8, 8); }},
      {"MakeTorus: across", [] { MakeTorus(2, 1, 8, 2); }},
      {"MakeL: width", [] { MakeL(1, 1, 1); }},
      {"MakeU: wall", [] { MakeU(1, 0.5, 1); }},
      {"MakePlateWithHole: hole", [] { MakePlateWithHole(1, 1, 1); }},
      {"MakePlateWithRoundHole: radius",
       [] { MakePlateWithRoundHole(1, 1, 0.5, 8); }},
      {"MakePrism: height", [] { MakePrism(1, kNaN, 8); }},
      {"MakeVessel: inner", [] { MakeVessel(1, 1, 0); }},
      {"MakeVessel: window", [] { MakeVessel(3, 2, 2); }},
      {"MakeVessel: window", [] { MakeVessel(3, 2, -1); }},
      {"MakeVessel: window", [] { MakeVessel(3, 2, kNaN); }},
      {"MakeStar: outer_radius", [] { MakeStar(1, 0); }},
      {"MakeBlob: radius", [] { MakeBlob(0, 2, 0.1, 1); }},
      {"MakeBlob: roughness", [] { MakeBlob(1, 2, 1.0, 1); }},
      {"MakeBlob: roughness", [] { MakeBlob(1, 2, kNaN, 1); }},
      {"MakeKnot: tube", [] { MakeKnot(1, 0.5, 64, 8); }},
      {"MakeKnot: around", [] { MakeKnot(1, 0.1, 31, 8); }},
  };
  for (const auto& [expected, make] : refused) {
    try {
      make();
      ADD_FAILURE() << "accepted; expected a refusal of " << expected;
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.rfind(expected + " must be ", 0), 0u) << what;
      EXPECT_NE(what.find(", found "), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
  }
}

// One draw a statement, whatever order a compiler takes arguments in: the same
// seed is the same scene everywhere.
TEST(RandomVector, DrawsZThenYThenX) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::mt19937_64 random(3), again(3);
  const Vector3d v = RandomVector(&unit, &random);
  EXPECT_EQ(v.z(), unit(again));
  EXPECT_EQ(v.y(), unit(again));
  EXPECT_EQ(v.x(), unit(again));
}

TEST(RandomRotation, DrawsOneNumberAStatement) {
  std::mt19937_64 random(3), again(3);
  const Eigen::Matrix3d found = RandomRotation(&random);
  std::normal_distribution<double> normal;
  std::array<double, 4> draws;
  for (double& draw : draws) draw = normal(again);
  const Eigen::Quaterniond q(draws[3], draws[2], draws[1], draws[0]);
  EXPECT_EQ(found, q.normalized().toRotationMatrix());
}

}  // namespace
}  // namespace phongpd
