// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: rational inside test, CGAL's distances in long double, and exact
// collision of the original solids.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/motion_oracle.h"
#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/exact_answers.h"
#include "tests/support/metrics.h"
#include "tests/support/oracle_of.h"
#include "tests/support/random_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::IsWhole;
using testing::SignOf;

constexpr std::uint64_t kTouchingSeed = 3;

std::vector<std::pair<std::string, TriangleMesh>> Shapes() {
  const Eigen::Matrix3d turn = GenericRotation();
  return {
      {"box", MakeBox(Vector3d(-1, -2, -3), Vector3d(3, 2, 1))},
      {"turned box",
       Rotated(MakeBox(Vector3d(-1, -2, -3), Vector3d(3, 2, 1)), turn)},
      {"turned U", Rotated(MakeU(2.0, 0.4, 0.7), turn)},
      {"star", MakeStar(0.6, 1.2)},
      {"plate with hole", MakePlateWithHole(2.0, 0.2, 0.9)},
      {"cone and box", BuildContactSpace(MakeBox(Vector3d(-0.1, -0.2, -0.1),
                                                 Vector3d(0.2, 0.1, 0.3)),
                                         MakeCone(1.0, 2.0, 9))
                           .mesh()},
      {"L", MakeL(2.0, 0.4, 0.6)},
      {"turned cone", Rotated(MakeCone(0.5, 3.0, 40), turn)},
      {"ball", MakeIcoBall(1.0, 2)},
      {"torus", Rotated(MakeTorus(1.0, 0.3, 16, 8), turn)},
      {"box shell", MakeBoxShell(Vector3d(-1, -1, -1), Vector3d(1, 1, 1), 0.3)},
      {"blob", MakeBlob(1.0, 2, 0.3, 5)},
  };
}

// 0, ±1e-16 … ±1e-3, ascending.
std::vector<double> Gaps() {
  std::vector<double> gaps = {0.0};
  for (int decade = -16; decade <= -3; ++decade) {
    gaps.push_back(std::pow(10.0, decade));
    gaps.push_back(-gaps.back());
  }
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

struct Ray {
  Vector3d foot = Vector3d::Zero(), direction = Vector3d::Zero();
  bool is_facet = false;  // along its normal, from its inside
};

// Facets' normals; from edges and vertices directions between those of the
// facets there.
std::vector<Ray> Rays(const TriangleMesh& mesh, long count,
                      std::mt19937_64* random) {
  std::uniform_real_distribution<double> unit(0.1, 1.0);
  std::vector<Ray> rays;
  for (long i = 0; i < count; ++i) {
    const Triangle& t = mesh.triangles[(*random)() % mesh.triangles.size()];
    Vector3d lambda(unit(*random), unit(*random), unit(*random));
    if (i % 3 == 1) lambda[2] = 0.0;
    if (i % 3 == 2) lambda = Vector3d::Unit(0);
    lambda /= lambda.sum();
    Ray ray;
    for (int k = 0; k < 3; ++k) ray.foot += lambda[k] * mesh.vertices[t[k]];
    ray.is_facet = i % 3 == 0;
    for (const Triangle& other : mesh.triangles) {
      int shared = 0;
      for (int k = 0; k < 3; ++k) {
        const bool needed = lambda[k] > 0.0;
        shared += needed && std::count(other.begin(), other.end(), t[k]) > 0;
      }
      if (shared != (lambda.array() > 0.0).count()) continue;
      const Vector3d& a = mesh.vertices[other[0]];
      const Vector3d normal = (mesh.vertices[other[1]] - a)
                                  .cross(mesh.vertices[other[2]] - a)
                                  .normalized();
      ray.direction += (ray.is_facet ? 1.0 : unit(*random)) * normal;
    }
    ray.direction.normalize();
    rays.push_back(ray);
  }
  return rays;
}

TEST(TouchingCampaign, SignIsExactAndMonotoneAndDirectionsAreUnit) {
  std::mt19937_64 random(kTouchingSeed);
  long failures = 0, cases = 0, at_zero = 0;
  double worst = 0.0;
  for (const auto& [name, mesh] : Shapes()) {
    const double diagonal = ComputeBounds(mesh).Diagonal();
    const auto metrics =
        testing::EuclideanAndPhong(TakeAsContactSpace(mesh), 0.1);
    const FreeSpace free({TakeAsContactSpace(mesh)});
    for (const Ray& ray : Rays(mesh, testing::CampaignCases(9, 150), &random)) {
      int last_sign = -1;
      std::vector<Branch> branches(metrics.size());
      for (const double gap : Gaps()) {
        const Vector3d q = ray.foot + gap * diagonal * ray.direction;
        const int sign = SignOf(testing::RationalLocation(mesh, q));
        const double truth = testing::TrueDistance(mesh, q);
        ++cases;
        bool right = free.IsFree(q) == (sign > 0);
        if (ray.is_facet && sign < last_sign) right = false;
        last_sign = sign;
        at_zero += sign == 0 ? 1 : 0;
        double euclid = 0.0;
        for (std::size_t m = 0; m < metrics.size(); ++m) {
          const PenetrationResult cold = metrics[m]->Query(q);
          const PenetrationResult warm = metrics[m]->Query(q, branches[m]);
          branches[m] = warm.branch;
          for (const PenetrationResult* r : {&cold, &warm}) {
            right = right && IsWhole(*r) && SignOf(*r) == sign;
            const double size = std::abs(r->signed_distance);
            if (m == 0) {
              euclid = size;
              worst = std::max(worst, std::abs(size - truth) / diagonal);
            } else {  // PhongPD is not below Euclidean PD
              right = right && size >= euclid - 1e-12 * diagonal;
            }
          }
        }
        right = right && std::abs(euclid - truth) <= 1e-12 * diagonal;
        if (right) continue;
        ++failures;
        ADD_FAILURE() << name << ", gap " << gap << " L at "
                      << ray.foot.transpose() << ": sign " << sign
                      << ", distance " << truth << ", found " << euclid;
      }
    }
  }
  EXPECT_EQ(failures, 0);
  EXPECT_GT(at_zero, 0);
  testing::ReportCampaign({"3 touching",
                           "12 shapes, facets, edges, vertices, gaps 0, ±1e-16 "
                           "… ±1e-3 L; Euclid and Phong, cold and warm, judge",
                           cases, failures, worst, 1e-12, "L", kTouchingSeed});
}

// Exact fits and contacts on a lattice: what touches is not free, for the
// query (not inside at distance 0, or inside where slots of no width close),
// for the judge and for the original solids alike; a step of 2⁻²⁰ off it is.
TEST(TouchingCampaign, MeansTheSameForQueryJudgeAndSolids) {
  std::mt19937_64 random(kTouchingSeed);
  std::vector<SolidPair> pairs;
  const std::uint64_t seeds =
      static_cast<std::uint64_t>(testing::CampaignCases(5, 40));
  for (const PairKind kind :
       {PairKind::kAligned, PairKind::kPeg, PairKind::kEdgeTouch,
        PairKind::kVertexTouch, PairKind::kCavity}) {
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      SolidPair pair = MakeRandomPair(kind, seed);
      if (pair.is_exact) pairs.push_back(std::move(pair));
    }
  }
  ASSERT_GE(pairs.size(), 5u);
  const long count = testing::CampaignCases(3000, 100000);
  const long each = count / static_cast<long>(pairs.size()) + 1;
  long cases = 0, failures = 0, touching = 0, free_cases = 0;
  for (const SolidPair& pair : pairs) {
    const TriangleMesh mesh =
        BuildContactSpace(pair.robot, pair.obstacle).mesh();
    const EuclideanMetric euclid(TakeAsContactSpace(mesh));
    const PhongMetric phong =
        testing::UnsmoothedPhong(TakeAsContactSpace(mesh));
    const FreeSpace free({TakeAsContactSpace(mesh)});
    const MotionOracle solids = testing::OracleOf(pair.robot, pair.obstacle);
    for (long i = 0; i < each; ++i) {
      // Coordinates of vertices of C_cont, or of a contact of two vertices.
      Vector3d q;
      for (int k = 0; k < 3; ++k) {
        q[k] =
            random() % 2 == 0
                ? mesh.vertices[random() % mesh.vertices.size()][k]
                : pair.obstacle.vertices[random() %
                                         pair.obstacle.vertices.size()][k] -
                      pair.robot
                          .vertices[random() % pair.robot.vertices.size()][k];
      }
      if (i % 2 == 1) {  // a step off
        q[static_cast<int>(random() % 3)] +=
            random() % 2 == 0 ? 0x1p-20 : -0x1p-20;
      }
      const PenetrationResult e = euclid.Query(q), p = phong.Query(q);
      const bool apart = !solids.Collides(q);
      const bool by_query = !e.inside && e.signed_distance > 0.0;
      ++cases;
      touching += !e.inside && e.signed_distance == 0.0 ? 1 : 0;
      free_cases += apart ? 1 : 0;
      if (by_query == apart && free.IsFree(q) == apart &&
          free.IsFree(q, q) == apart && free.Check(q, q).free == apart &&
          p.inside == e.inside &&
          (p.inside || p.signed_distance == e.signed_distance) && IsWhole(e) &&
          IsWhole(p)) {
        continue;
      }
      ++failures;
      ADD_FAILURE() << "q " << q.transpose() << ": solids apart " << apart
                    << ", inside " << e.inside << " at " << e.signed_distance
                    << ", judge " << free.IsFree(q);
    }
  }
  EXPECT_EQ(failures, 0);
  EXPECT_GT(touching, cases / 20);
  EXPECT_GT(free_cases, cases / 20);
  testing::ReportCampaign({"3 touching",
                           "lattice contacts and exact fits: query, judge and "
                           "solids agree",
                           cases, failures, 0.0, 0.0, "", kTouchingSeed});
}

}  // namespace
}  // namespace phongpd
