// SPDX-License-Identifier: GPL-3.0-or-later
// Branches that no query of this space made: every one is an error that says
// so, or a state that is continued as far as it is one, or a cold query.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <climits>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "constraints/non_penetration.h"
#include "constraints/signed_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/expect_refused.h"
#include "tests/support/metrics.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr double kInf = std::numeric_limits<double>::infinity();
const double kNan = std::nan("");
constexpr std::uint64_t kBranchSeed = 8;

NonPenetrationConstraint Rows(int waypoints, int spaces) {
  const auto metric =
      std::make_shared<SignedMetric>(TakeAsContactSpace(MakeIcoBall(0.8, 1)));
  return NonPenetrationConstraint(
      std::vector<std::shared_ptr<const SignedMetric>>(
          static_cast<std::size_t>(spaces), metric),
      Vector3d(-2, 0, 0), Vector3d(2, 0, 0), waypoints,
      std::vector<int>(static_cast<std::size_t>(waypoints) + 1, 1));
}

template <typename Call>
void ExpectRefused(const Call& call, std::size_t expected, std::size_t found) {
  const std::string what = testing::ErrorOf([&] { call(); });
  EXPECT_NE(what.find(std::to_string(expected)), std::string::npos) << what;
  EXPECT_NE(what.find("found " + std::to_string(found)), std::string::npos)
      << what;
}

// Empty, too short, too long, of another constraint.
TEST(BranchSets, OfAnotherSizeAreRefusedByEveryUser) {
  const NonPenetrationConstraint rows = Rows(3, 2);
  const std::vector<double> u(9, 0.1);
  const BranchSet good = rows.Start(u.data(), nullptr);
  const std::size_t size = good.branches.size();
  ASSERT_EQ(size, 2u * static_cast<std::size_t>(rows.samples()));
  std::vector<BranchSet> bad = {{},
                                good,
                                good,
                                Rows(2, 2).Start(u.data(), nullptr),
                                Rows(3, 1).Start(u.data(), nullptr)};
  bad[1].branches.pop_back();
  bad[2].branches.emplace_back();
  std::vector<double> values(200), jacobian(500);
  for (BranchSet& set : bad) {
    const std::size_t found = set.branches.size();
    ExpectRefused(
        [&] {
          rows.Evaluate(u.data(), set, values.data(), jacobian.data(), nullptr);
        },
        size, found);
    ExpectRefused([&] { rows.Commit(u.data(), &set, nullptr); }, size, found);
  }
  EXPECT_TRUE(
      rows.Evaluate(u.data(), good, values.data(), jacobian.data(), nullptr));
}

bool IsFinite(const PenetrationResult& r) {
  return std::isfinite(r.signed_distance) && r.contact.allFinite() &&
         r.direction.allFinite() && r.gradient.allFinite() &&
         r.branch.lambda.allFinite() && std::isfinite(r.branch.s);
}

bool IsSame(const PenetrationResult& a, const PenetrationResult& b) {
  return a.status == b.status && a.signed_distance == b.signed_distance &&
         a.contact == b.contact && a.direction == b.direction &&
         a.triangle == b.triangle && a.branch.triangle == b.branch.triangle;
}

// What no query returns is no branch: the answer is the cold one, to the bit.
TEST(Branches, WithImpossibleMembersAreColdQueries) {
  const TriangleMesh mesh = MakeU(2.0, 0.5, 0.8);
  std::vector<Branch> bad;
  for (const int triangle : {-1, -7, INT_MIN, INT_MAX, 1 << 20}) {
    bad.push_back({triangle, Vector3d(1, 0, 0), -0.1});
  }
  for (const Vector3d& lambda :
       {Vector3d(kNan, 0.5, 0.5), Vector3d(kInf, 0, 0),
        Vector3d(-kInf, kInf, 1), Vector3d(-0.5, 1, 0.5), Vector3d(0, 0, 0),
        Vector3d(1, 1, 1), Vector3d(1e308, 1e308, 1e308)}) {
    bad.push_back({0, lambda, -0.1});
  }
  for (const double s : {kNan, kInf, -kInf, 1e60, -1e60, -1e300}) {
    bad.push_back({0, Vector3d(0.5, 0.25, 0.25), s});
  }
  for (const FieldKind field : {FieldKind::kNormal, FieldKind::kTangentPlane}) {
    const PhongMetric metric =
        testing::UnsmoothedPhong(TakeAsContactSpace(mesh), field);
    for (const Vector3d& q : {Vector3d(0.2, 0.9, 0.4), Vector3d(1, 0.1, 0.3),
                              Vector3d(1, 1, 0.4), Vector3d(9, 9, 9)}) {
      const PenetrationResult cold = metric.Query(q);
      for (const Branch& branch : bad) {
        EXPECT_TRUE(IsSame(metric.Query(q, branch), cold));
        EXPECT_TRUE(IsSame(metric.QueryRing(q, branch, 2), cold));
      }
    }
  }
}

// A branch of another space, or made up, may happen to be a state of this one.
// Then what comes out is a projection of q on this surface or says that the
// branch ended; never NaN, never a crash.
TEST(StaleBranchesCampaign, GiveProjectionsOfThisSpaceOrSayThatTheyEnded) {
  std::vector<TriangleMesh> meshes = {MakeU(2.0, 0.5, 0.8), MakeIcoBall(1.0, 2),
                                      MakeStar(0.6, 1.2),
                                      MakePlateWithHole(2.0, 0.01, 0.9),
                                      Scaled(MakeTorus(1, 0.3, 12, 8), 1e60)};
  std::vector<PhongMetric> metrics;
  for (const TriangleMesh& mesh : meshes) {
    for (const double ell : {0.0, 0.2}) {
      PhongMetricOptions options;
      options.field_options.smoothing_length = ell;
      metrics.emplace_back(TakeAsContactSpace(mesh), options);
    }
    metrics.push_back(testing::UnsmoothedPhong(TakeAsContactSpace(mesh),
                                               FieldKind::kTangentPlane));
  }
  std::mt19937_64 random(kBranchSeed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const long cases = testing::CampaignCases(3000, 300000);
  long failures = 0, followed = 0, ended = 0;
  double worst = 0.0;
  Branch last;
  for (long i = 0; i < cases; ++i) {
    const std::size_t m = random() % metrics.size();
    const TriangleMesh& mesh = meshes[m / 3];
    const BoundingBox box = ComputeBounds(mesh);
    const double diagonal = box.Diagonal();
    Branch branch = last;  // of whatever space came before
    if (i % 3 != 0) {
      branch.triangle = static_cast<int>(random() % mesh.triangles.size());
      branch.lambda = Vector3d(unit(random), unit(random), unit(random));
      if (random() % 3 == 0) branch.lambda[static_cast<int>(random() % 3)] = 0;
      branch.lambda /= branch.lambda.sum();
      // Of any size and either sign.
      branch.s = (random() % 2 == 0 ? -1.0 : 1.0) * diagonal *
                 std::pow(10.0, 40.0 * unit(random) * unit(random) *
                                    (random() % 2 == 0 ? -1.0 : 1.0));
      if (random() % 50 == 0) branch.s = random() % 2 == 0 ? 5e-324 : -1e300;
    }
    const Vector3d q = testing::RandomPoint(box, &random);
    const PenetrationResult warm = metrics[m].Query(q, branch);
    const PenetrationResult ring = metrics[m].QueryRing(q, branch, 1);
    last = warm.branch;
    bool right = IsFinite(warm) && IsFinite(ring);
    right = right && warm.inside == metrics[m].IsInside(q) &&
            ring.inside == warm.inside &&
            warm.status != QueryStatus::kInvalid &&
            ring.status != QueryStatus::kInvalid;
    if (warm.status == QueryStatus::kBranchEnded) ++ended;
    for (const PenetrationResult* r : {&warm, &ring}) {
      if (!r->inside || !r->branch.IsValid()) continue;
      ++followed;
      // q_c − q = depth · n̂, and q_c is on its triangle.
      const double off =
          (r->contact - q + r->signed_distance * r->direction).norm() /
          diagonal;
      const Triangle& t = mesh.triangles[static_cast<std::size_t>(r->triangle)];
      const Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
      const Vector3d normal =
          (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
              .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
              .stableNormalized();
      const double above = std::abs(normal.dot(r->contact - a)) / diagonal;
      worst = std::max({worst, off, above});
      right = right && off < 1e-9 && above < 1e-9;
    }
    if (!right) {
      ++failures;
      ADD_FAILURE() << "case " << i << ", metric " << m << ", q "
                    << q.transpose() << ", triangle " << branch.triangle
                    << " λ " << branch.lambda.transpose() << " s " << branch.s
                    << ": status " << static_cast<int>(warm.status) << ", "
                    << static_cast<int>(ring.status) << ", depths "
                    << warm.signed_distance << ", " << ring.signed_distance;
    }
  }
  EXPECT_EQ(failures, 0);
  EXPECT_GT(followed, cases / 10);
  EXPECT_GT(ended, cases / 10);
  testing::ReportCampaign({"4 queries",
                           "stale and made-up branches, both fields, warm and "
                           "ring",
                           cases, failures, worst, 1e-9, "L", kBranchSeed});
}

}  // namespace
}  // namespace phongpd
