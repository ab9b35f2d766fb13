// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: rational inside test, CGAL's distances in long double.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/exact_answers.h"
#include "tests/support/metrics.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 4;

struct Subject {
  std::string name;
  TriangleMesh mesh;
};

TriangleMesh Sum(const TriangleMesh& robot, const TriangleMesh& obstacle) {
  return BuildContactSpace(robot, obstacle).mesh();
}

// Aspects to 1e6, symmetric ones, knife edges, cavities.
std::vector<Subject> Subjects() {
  const TriangleMesh cube = MakeBox(Vector3d::Constant(-1), {1, 1, 1});
  const TriangleMesh speck = Scaled(cube, 1e-7);
  const Eigen::Matrix3d turn = GenericRotation();
  return {
      {"cube", cube},
      {"needle", Sum(speck, MakeCone(1e-6, 1.0, 3))},
      {"turned needle", Rotated(Sum(speck, MakeCone(1e-6, 1.0, 3)), turn)},
      {"rod", MakeBox(Vector3d(-1, -1e-6, -1e-6), Vector3d(1, 1e-6, 1e-6))},
      {"plate", MakeBox(Vector3d(-1, -1, -1e-6), Vector3d(1, 1, 1e-6))},
      {"turned plate with hole",
       Rotated(MakePlateWithHole(2.0, 1e-6, 0.9), turn)},
      {"knife", Sum(speck, MakePrism(1.0, 2.0, 3))},
      {"ball", MakeIcoBall(1.0, 2)},
      {"L", MakeL(2.0, 0.4, 0.6)},
      {"shell", MakeBoxShell(Vector3d(-1, -1, -1), Vector3d(1, 1, 1), 1e-6)},
      {"torus", MakeTorus(1.0, 0.3, 16, 8)},
      {"spikes", MakeStar(0.05, 1.0)},
  };
}

// Paths of points: along edges, from vertex to vertex, through the middle,
// and along the line of middles, each in `steps` steps.
std::vector<std::vector<Vector3d>> Paths(const Subject& subject, long count,
                                         long steps, std::mt19937_64* random) {
  const TriangleMesh& mesh = subject.mesh;
  const BoundingBox box = ComputeBounds(mesh);
  const auto vertex = [&] {
    return mesh.vertices[(*random)() % mesh.vertices.size()];
  };
  const auto line = [&](const Vector3d& a, const Vector3d& b) {
    std::vector<Vector3d> path;
    for (long i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(steps);
      path.push_back(i == steps ? b : Vector3d(a + t * (b - a)));
    }
    return path;
  };
  std::vector<std::vector<Vector3d>> paths;
  for (long i = 0; i < count; ++i) {
    const Triangle& t = mesh.triangles[(*random)() % mesh.triangles.size()];
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]];
    const Vector3d beyond = b + 0.25 * (b - a);
    const Vector3d center = box.Center();
    switch (i % 5) {
      case 0:  // along an edge and on
        paths.push_back(line(a, beyond));
        break;
      case 1:  // through a vertex, from the middle outwards
        paths.push_back(line(center, a + 0.5 * (a - center)));
        break;
      case 2:
        paths.push_back(line(vertex(), vertex()));
        break;
      case 3:  // from mirror image to mirror image
        paths.push_back(line(a, 2.0 * center - a));
        break;
      default: {  // in the planes of symmetry
        Vector3d from = box.min, to = box.max;
        from[i % 3] = to[i % 3] = center[i % 3];
        if ((*random)() % 2 == 0) std::swap(from[(i + 1) % 3], to[(i + 1) % 3]);
        paths.push_back(line(from, to));
      }
    }
  }
  return paths;
}

// Single points: vertices and middles of edges, far away, nearly zero.
std::vector<Vector3d> Points(const Subject& subject, long count,
                             std::mt19937_64* random) {
  const TriangleMesh& mesh = subject.mesh;
  const BoundingBox box = ComputeBounds(mesh);
  const double diagonal = box.Diagonal();
  constexpr double kDenormal = std::numeric_limits<double>::denorm_min();
  const std::vector<double> tiny = {0.0,    -0.0,    kDenormal, -kDenormal,
                                    1e-310, -1e-310, 1e-200,    1e-17};
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vector3d> points;
  for (long i = 0; i < count; ++i) {
    const Triangle& t = mesh.triangles[(*random)() % mesh.triangles.size()];
    const Vector3d direction(unit(*random), unit(*random), unit(*random));
    Vector3d q = mesh.vertices[t[0]];
    if (i % 4 == 1) q = 0.5 * (q + mesh.vertices[t[1]]);
    if (i % 4 == 2) {
      q = direction * diagonal *
          std::pow(10.0, 6 + 3 * static_cast<int>(i % 5));
    }
    if (i % 4 == 3) {
      for (int k = 0; k < 3; ++k) q[k] = tiny[(*random)() % tiny.size()];
    }
    points.push_back(q);
  }
  return points;
}

TEST(ExtremeQueriesCampaign, SignIsExactAndDepthRightWhereverTheyAre) {
  std::mt19937_64 random(kSeed);
  long cases = 0, failures = 0, inside = 0, on = 0, ended = 0;
  double worst = 0.0;
  for (const Subject& subject : Subjects()) {
    const TriangleMesh& mesh = subject.mesh;
    const double diagonal = ComputeBounds(mesh).Diagonal();
    const auto metrics =
        testing::EuclideanAndPhong(TakeAsContactSpace(mesh), 0.05);
    std::vector<std::vector<Vector3d>> paths =
        Paths(subject, testing::CampaignCases(5, 100), 40, &random);
    for (const Vector3d& q :
         Points(subject, testing::CampaignCases(24, 2000), &random)) {
      paths.push_back({q});
    }
    for (const std::vector<Vector3d>& path : paths) {
      std::vector<Branch> branches(metrics.size());
      for (const Vector3d& q : path) {
        const int sign = testing::SignOf(testing::RationalLocation(mesh, q));
        const double truth = testing::TrueDistance(mesh, q);
        // Far away, coordinates are what is known.
        const double size = diagonal + q.norm();
        bool right = true;
        for (std::size_t m = 0; m < metrics.size(); ++m) {
          const PenetrationResult cold = metrics[m]->Query(q);
          const PenetrationResult warm = metrics[m]->Query(q, branches[m]);
          branches[m] = warm.branch;
          ended += warm.status == QueryStatus::kBranchEnded ? 1 : 0;
          for (const PenetrationResult* r : {&cold, &warm}) {
            right =
                right && testing::IsWhole(*r) && testing::SignOf(*r) == sign;
            const double found = std::abs(r->signed_distance);
            if (m == 0 || !r->inside) {
              worst = std::max(worst, std::abs(found - truth) / size);
              right = right && std::abs(found - truth) <= 1e-14 * size;
            } else {
              right = right && found >= truth - 1e-13 * size;
            }
            // q_c is where it is said to be; Phong's λ are known to 1e-9 in
            // slivers.
            const double off = std::abs((r->contact - q).norm() - found);
            right = right && off <= (r->branch.IsValid() ? 1e-9 : 1e-12) * size;
          }
        }
        ++cases;
        inside += sign < 0 ? 1 : 0;
        on += sign == 0 ? 1 : 0;
        if (right) continue;
        ++failures;
        const PenetrationResult e = metrics[0]->Query(q);
        const PenetrationResult p = metrics[1]->Query(q);
        ADD_FAILURE() << subject.name << ", q " << q.transpose() << ": sign "
                      << sign << ", distance " << truth << "; Euclid "
                      << e.signed_distance << ", Phong " << p.signed_distance
                      << " status " << static_cast<int>(p.status) << " contact "
                      << p.contact.transpose();
      }
    }
  }
  EXPECT_EQ(failures, 0);
  EXPECT_GT(inside, cases / 20);
  EXPECT_GT(on, cases / 20);
  EXPECT_GT(ended, 0);
  testing::ReportCampaign(
      {"4 queries",
       "needles, plates, knives to aspect 1e6; along edges, medial axes, "
       "through vertices, far, denormal; rational sign, distances by CGAL",
       cases, failures, worst, 1e-14, "of L + |q|", kSeed});
}

TEST(ExtremeQueries, PointsThatAreNotFiniteAreInvalidAndZero) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const TriangleMesh mesh = MakeL(2.0, 0.4, 0.6);
  const EuclideanMetric euclid(TakeAsContactSpace(mesh));
  const PhongMetric phong = testing::UnsmoothedPhong(TakeAsContactSpace(mesh));
  const Branch branch = phong.Query(Vector3d(0.2, 0.2, 0.3)).branch;
  ASSERT_TRUE(branch.IsValid());
  for (const double bad : {std::nan(""), kInf, -kInf}) {
    for (int axes = 1; axes < 8; ++axes) {
      Vector3d q(0.2, 0.2, 0.3);
      for (int k = 0; k < 3; ++k) {
        if ((axes >> k) % 2 == 1) q[k] = bad;
      }
      for (const PenetrationResult& r :
           {euclid.Query(q), phong.Query(q), phong.Query(q, branch),
            phong.QueryRing(q, branch, 1)}) {
        EXPECT_EQ(r.status, QueryStatus::kInvalid);
        EXPECT_FALSE(r.inside);
        EXPECT_EQ(r.signed_distance, 0.0);
        EXPECT_TRUE(r.direction.isZero() && r.gradient.isZero());
        EXPECT_TRUE(r.contact.isZero());
        EXPECT_EQ(r.triangle, -1);
        EXPECT_FALSE(r.branch.IsValid());
      }
      std::vector<PenetrationResult> all(3);
      phong.QueryAll(q, 1.0, &all);
      EXPECT_TRUE(all.empty());
    }
  }
}

// Where no coordinate overflows, norms may: coordinates may be far, never
// wrong.
TEST(ExtremeQueries, PointsAtTheEndOfDoublesAreOutside) {
  const TriangleMesh mesh = MakeL(2.0, 0.4, 0.6);
  const EuclideanMetric euclid(TakeAsContactSpace(mesh));
  const PhongMetric phong = testing::UnsmoothedPhong(TakeAsContactSpace(mesh));
  for (const double far :
       {1e100, 1e200, 1e300, 1.7e308, std::numeric_limits<double>::max()}) {
    for (const Vector3d& d : {Vector3d(1, 0, 0), Vector3d(-1, 1, -1)}) {
      for (const PenetrationResult& r :
           {euclid.Query(far * d), phong.Query(far * d)}) {
        EXPECT_FALSE(r.inside);
        EXPECT_FALSE(std::isnan(r.signed_distance));
        EXPECT_GE(r.signed_distance, 0.999 * far);
        EXPECT_TRUE(testing::IsWhole(r)) << far;
      }
    }
  }
}

}  // namespace
}  // namespace phongpd
