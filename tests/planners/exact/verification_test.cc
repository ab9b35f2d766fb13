// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/verification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "core/solid/solid.h"
#include "planners/exact/contact_surface_planner.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/metrics.h"
#include "tests/support/planned_scenes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

TriangleMesh Box(double low, double high) {
  return MakeBox(Vector3d::Constant(low), Vector3d::Constant(high));
}

// C_obj = [−2, 2]³ in bounds [−9, 9]³.
Workspace TwoCubes() {
  return {MakeSolid(Box(-1.0, 1.0), "robot"),
          {MakeSolid(Box(-1.0, 1.0), "cube")},
          {Vector3d::Constant(-9.0), Vector3d::Constant(9.0)}};
}

TEST(VerifyPath, ConfirmsFreePathsAndRefutesOnesThatCross) {
  const Verifier verifier(TwoCubes());
  const Path around = {{-5, 0, 0}, {0, 5, 0}, {5, 0, 0}};
  EXPECT_EQ(verifier.VerifyPath(around).verdict, Verdict::kConfirmed);
  const Verification crossing =
      verifier.VerifyPath({{-5, 5, 0}, {-5, 0, 0}, {5, 0, 0}});
  EXPECT_EQ(crossing.verdict, Verdict::kRefuted);
  EXPECT_EQ(crossing.reason,
            "segment 1 collides with obstacle 'cube' at fraction 0.300000");
  EXPECT_EQ(verifier.VerifyPath({}).verdict, Verdict::kRefuted);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verifier.VerifyPath({{-5, nan, 0}}).verdict, Verdict::kRefuted);
  EXPECT_EQ(verifier.VerifyPath({{-5, 0, 0}, {-9, 0, 0}}).verdict,
            Verdict::kWithinRounding);
  EXPECT_EQ(verifier.VerifyPath({{-5, 0, 0}, {-9.001, 0, 0}}).verdict,
            Verdict::kRefuted);
}

// A path along a face, moved through it by a share of the diagonal L.
TEST(VerifyPath, RefutesWhatCrossesByABillionthOfTheDiagonal) {
  const Verifier verifier(TwoCubes());
  const double diagonal = 4.0 * std::sqrt(3.0);
  EXPECT_LT(verifier.rounding(), 1e-9 * diagonal);
  for (int k = 0; k < 3; ++k) {
    const auto along = [&](double level) {
      Vector3d a = Vector3d::Constant(-3.0), b = Vector3d::Constant(3.0);
      a[k] = b[k] = level;
      b[(k + 1) % 3] = 0.5;
      return verifier.VerifyPath({a, b}).verdict;
    };
    for (const double side : {-2.0, 2.0}) {
      const double inward = side > 0 ? -diagonal : diagonal;
      EXPECT_EQ(along(side - 1e-9 * inward), Verdict::kConfirmed);
      EXPECT_EQ(along(side), Verdict::kWithinRounding);
      EXPECT_EQ(along(std::nextafter(side, 2 * side)), Verdict::kConfirmed);
      EXPECT_EQ(along(side + 1e-15 * inward), Verdict::kWithinRounding);
      EXPECT_EQ(along(side + 1e-9 * inward), Verdict::kRefuted);
      EXPECT_EQ(along(side + 1e-3 * inward), Verdict::kRefuted);
    }
  }
}

TEST(VerifyBlocked, TellsFreeFromBlockedPlaces) {
  const Verifier verifier(TwoCubes());
  EXPECT_EQ(verifier.VerifyBlocked({0, 0, 0}).verdict, Verdict::kConfirmed);
  EXPECT_EQ(verifier.VerifyBlocked({2, 0, 0}).verdict, Verdict::kConfirmed);
  EXPECT_EQ(verifier.VerifyBlocked({9, 0, 0}).verdict, Verdict::kConfirmed);
  EXPECT_EQ(verifier.VerifyBlocked({2.1, 0, 0}).verdict, Verdict::kRefuted);
  EXPECT_EQ(verifier.VerifyBlocked({2 + 1e-15, 0, 0}).verdict,
            Verdict::kWithinRounding);
}

// The robot is inside a closed hollow box, or outside of it.
Workspace HollowBox() {
  return {
      MakeSolid(Box(-0.5, 0.5), "robot"),
      {MakeSolid(Joined(Box(-3.0, 3.0), Reversed(Box(-2.0, 2.0))), "shell")},
      {Vector3d::Constant(-9.0), Vector3d::Constant(9.0)}};
}

TEST(VerifySeparation, ConfirmsAProofAndRefutesAWrongContactSpace) {
  const Workspace workspace = HollowBox();
  const Verifier verifier(workspace);
  const TriangleMesh contact =
      BuildContactSpace(workspace.robot, MergedObstacle(workspace)).mesh();
  const Vector3d inside(0.1, 0.2, 0.3), outside(5.1, 5.2, 5.3);
  for (const bool swapped : {false, true}) {
    const Verification proof = verifier.VerifySeparation(
        contact, swapped ? outside : inside, swapped ? inside : outside);
    EXPECT_EQ(proof.verdict, Verdict::kConfirmed) << proof.reason;
    EXPECT_GE(proof.tests, 12);
  }
  // Nothing separates these two.
  EXPECT_EQ(verifier.VerifySeparation(contact, inside, -inside).verdict,
            Verdict::kRefuted);
  // A closed surface that does, but lies in free space.
  EXPECT_EQ(verifier.VerifySeparation(Reversed(Box(-1.0, 1.0)), inside, outside)
                .verdict,
            Verdict::kRefuted);
  // Contact spaces of other solids: a little larger, and much.
  for (const double shift : {1e-8, 0.1}) {
    TriangleMesh wrong = contact;
    for (Vector3d& v : wrong.vertices) v *= 1.0 + shift;
    EXPECT_EQ(verifier.VerifySeparation(wrong, inside, outside).verdict,
              Verdict::kRefuted)
        << shift;
  }
  // Not closed: proves nothing.
  TriangleMesh open = contact;
  open.triangles.clear();
  for (const Triangle& t : contact.triangles) {
    bool is_top = true;
    for (const int v : t) {
      is_top = is_top && contact.vertices[static_cast<std::size_t>(v)].z() > 0;
    }
    if (!is_top) open.triangles.push_back(t);
  }
  EXPECT_EQ(verifier.VerifySeparation(open, inside, outside).verdict,
            Verdict::kRefuted);
}

TEST(VerifyDepth, ConfirmsBothMetricsAndRefutesWrongDepths) {
  Workspace workspace;
  workspace.robot = MakeSolid(MakeCone(0.8, 1.6, 8), "robot");
  workspace.obstacles = {MakeSolid(MakeU(2.0, 0.4, 1.0), "U")};
  const Verifier verifier(workspace);
  const TriangleMesh contact =
      BuildContactSpace(workspace.robot, workspace.obstacles[0]).mesh();
  const EuclideanMetric euclidean(TakeAsContactSpace(contact));
  const PhongMetric phong =
      testing::UnsmoothedPhong(TakeAsContactSpace(contact));
  const BoundingBox box = ComputeBounds(contact);
  std::mt19937_64 random(11);
  int inside = 0, beside = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d q = testing::RandomPoint(box, &random);
    for (const PenetrationMetric* metric :
         {static_cast<const PenetrationMetric*>(&euclidean),
          static_cast<const PenetrationMetric*>(&phong)}) {
      const PenetrationResult right = metric->Query(q);
      inside += right.inside ? 1 : 0;
      const Verification found = verifier.VerifyDepth(q, right);
      // At an edge n may point along a facet.
      beside += found.verdict == Verdict::kWithinRounding ? 1 : 0;
      EXPECT_NE(found.verdict, Verdict::kRefuted) << found.reason;
      PenetrationResult wrong = right;
      wrong.inside = !right.inside;
      EXPECT_EQ(verifier.VerifyDepth(q, wrong).verdict, Verdict::kRefuted);
      wrong = right;  // too short by 1e-7 of it or so
      wrong.contact += 1e-7 * (q - right.contact);
      if (right.signed_distance < -0.1) {
        wrong.signed_distance = -(wrong.contact - q).norm();
        EXPECT_EQ(verifier.VerifyDepth(q, wrong).verdict, Verdict::kRefuted);
      }
      wrong = right;
      wrong.signed_distance *= 1.001;
      EXPECT_EQ(verifier.VerifyDepth(q, wrong).verdict, Verdict::kRefuted);
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_LE(beside, 6);  // 1 %
}

// Every answer of the complete planner on the families holds on the solids,
// and no path that is pushed into an obstacle does.
TEST(VerificationCampaign, ConfirmsThePlannerOnSceneFamilies) {
  testing::CampaignRow row;
  row.item = "verification";
  row.subject = "paths and proofs of the complete planner on scene families";
  for (const testing::PlannedScene& planned : testing::PlannedScenes()) {
    const Workspace& workspace = planned.scene.workspace;
    const Verifier verifier(workspace);
    ++row.cases;
    const Verification path = verifier.VerifyPath(planned.path);
    row.failures += path.verdict == Verdict::kConfirmed ? 0 : 1;
    EXPECT_EQ(path.verdict, Verdict::kConfirmed)
        << planned.name << ": " << path.reason;
    // The same by way of a place in contact.
    Path wrong = planned.path;
    wrong.insert(wrong.begin() + 1,
                 workspace.obstacles.front().mesh().vertices.front() -
                     workspace.robot.mesh().vertices.front());
    ++row.cases;
    const bool is_caught =
        verifier.VerifyPath(wrong).verdict != Verdict::kConfirmed;
    row.failures += is_caught ? 0 : 1;
    EXPECT_TRUE(is_caught) << planned.name;
  }
  EXPECT_GT(row.cases, 2 * testing::PlannedSceneSeeds());
  ReportCampaign(row);
}

}  // namespace
}  // namespace phongpd
