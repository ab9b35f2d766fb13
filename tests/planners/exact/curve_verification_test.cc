// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms; curves against every triangle of an exact contact
// surface in rationals; obstacles planted on the curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "constraints/curve_judge.h"
#include "constraints/motion_oracle.h"
#include "core/contact/contact_space.h"
#include "planners/exact/verification.h"
#include "planners/trajectory/curve_optimizer.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/curve_pieces.h"
#include "tests/support/curve_problems.h"
#include "tests/support/curve_truth.h"
#include "tests/support/planned_scenes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Arch;
using testing::Cube;
using testing::CurveTruth;

Workspace Of(const TriangleMesh& robot, const TriangleMesh& obstacle) {
  Workspace workspace;
  workspace.robot = MakeSolid(robot, "robot");
  workspace.obstacles = {MakeSolid(obstacle, "obstacle")};
  return workspace;
}

// A cube of side 0.5 over one of 1.5: in contact at |q|∞ = 1.
Verifier AroundCube() { return Verifier(Of(Cube(0.5), Cube(1.5))); }

TEST(VerifyCurve, ConfirmsArchesAndRefutesOnesThatCross) {
  const Verifier verifier = AroundCube();
  for (const double gap : {1.0, 1e-3, 1e-6, 1e-9, 1e-12}) {
    const Verification found = verifier.VerifyCurve(Arch(gap));
    EXPECT_EQ(found.verdict, Verdict::kConfirmed) << gap << found.reason;
    EXPECT_LE(found.tests, 1000) << gap;
  }
  for (const double depth : {1e-9, 1e-6, 1e-3, 0.1}) {
    const Verification found = verifier.VerifyCurve(Arch(-depth));
    EXPECT_EQ(found.verdict, Verdict::kRefuted) << depth;
  }
  EXPECT_EQ(verifier.VerifyCurve(Arch(-0.1)).reason,
            "piece 0 collides with obstacle 'obstacle' at 1 s");
  EXPECT_EQ(verifier.VerifyCurve(Trajectory()).verdict, Verdict::kRefuted);
}

TEST(VerifyCurve, TellsWhatTouchesFromWhatCrosses) {
  const Verifier verifier = AroundCube();
  ASSERT_GT(verifier.rounding(), 1e-11);
  ASSERT_LT(verifier.rounding(), 1e-9);
  for (const double depth : {0.0, 1e-15, 1e-12, 0.5 * verifier.rounding()}) {
    const Verification found = verifier.VerifyCurve(Arch(-depth));
    EXPECT_EQ(found.verdict, Verdict::kWithinRounding) << depth;
    EXPECT_LE(found.tests, 50'000) << depth;
  }
  // Along the face for all t: of degree 1, and of degree 3.
  for (const int degree : {1, 3}) {
    for (const double height : {1.0, std::nextafter(1.0, 2.0)}) {
      std::vector<Vector3d> points;
      for (int i = 0; i <= degree; ++i) {
        points.emplace_back(-2.0 + 4.0 * i / degree, 0.125 * i, height);
      }
      EXPECT_EQ(
          verifier.VerifyCurve(Trajectory({CurvePiece(points, 1.0)})).verdict,
          height > 1.0 ? Verdict::kConfirmed : Verdict::kWithinRounding)
          << degree;
    }
  }
}

TEST(VerifyCurve, JudgesPolylinesAsPaths) {
  const Verifier verifier = AroundCube();
  std::mt19937_64 random(3101);
  std::uniform_real_distribution<double> far(-2.0, 2.0);
  int confirmed = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Vector3d> path;
    for (int k = 0; k < 4; ++k) {
      path.emplace_back(far(random), far(random), far(random));
    }
    const Verdict expected = verifier.VerifyPath(path).verdict;
    EXPECT_EQ(verifier.VerifyCurve(Trajectory::Along(path)).verdict, expected);
    confirmed += expected == Verdict::kConfirmed;
  }
  EXPECT_GE(confirmed, 10);
  EXPECT_LE(confirmed, 190);
}

TEST(VerifyCurve, KeepsTheOpenBounds) {
  Workspace workspace = Of(Cube(0.5), Cube(1.5));
  workspace.bounds = {Vector3d::Constant(-3.0), Vector3d::Constant(3.0)};
  const Verifier verifier(workspace);
  const auto bow = [&](double top) {  // its summit is at `top`
    return verifier
        .VerifyCurve(Trajectory({CurvePiece(
            {{-2.0, 0.0, 1.5}, {0.0, 0.0, 2.0 * top - 1.5}, {2.0, 0.0, 1.5}},
            1.0)}))
        .verdict;
  };
  EXPECT_EQ(bow(3.0 - 1e-9), Verdict::kConfirmed);
  EXPECT_EQ(bow(3.0), Verdict::kWithinRounding);
  EXPECT_EQ(bow(3.0 + 1e-8), Verdict::kRefuted);
}

// No surfaces meet: only what holds what can tell.
TEST(VerifyCurve, RefutesCurvesWithinASolid) {
  const Trajectory small(
      {CurvePiece({{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.1, 0.1, 0.0}}, 1.0)});
  const TriangleMesh large = Cube(4.0), tiny = Cube(0.25);
  EXPECT_EQ(Verifier(Of(tiny, large)).VerifyCurve(small).verdict,
            Verdict::kRefuted);
  EXPECT_EQ(Verifier(Of(large, tiny)).VerifyCurve(small).verdict,
            Verdict::kRefuted);
  const TriangleMesh hollow = Joined(Cube(6.0), Reversed(Cube(4.0)));
  EXPECT_EQ(Verifier(Of(tiny, hollow)).VerifyCurve(small).verdict,
            Verdict::kConfirmed);
}

Trajectory RandomCurve(const FreeSpace& space, const ContactSpace& contact,
                       std::mt19937_64* random) {
  return Trajectory({testing::RandomPiece(space, contact, 0.12, random)});
}

struct MeshPair {
  TriangleMesh robot, obstacle;
  bool is_exact;  // its contact surface: coordinates of few digits
};

std::vector<MeshPair> MeshPairs() {
  std::mt19937_64 random(3102);
  std::vector<MeshPair> pairs = {
      {Cube(0.5), Cube(1.5), true},
      {Cube(0.3), MakeTorus(1.0, 0.4, 20, 12), false},
      {MakeStar(0.2, 0.5), MakeL(2.0, 0.6, 0.8), false}};
  for (int i = 0; i < 3; ++i) {
    TriangleMesh voxels = testing::RandomVoxelSolid(4, 0.4, &random);
    const Eigen::Matrix3d turn = testing::RandomRotation(&random);
    if (i > 0) {
      for (Vector3d& p : voxels.vertices) p = turn * p;
    }
    pairs.push_back({Cube(0.5), voxels, i == 0});
  }
  return pairs;
}

struct CurveTally {
  long cases = 0, wrong = 0, undecided = 0, confirmed = 0, refuted = 0;
  double seconds = 0.0;
};

// `is_clear`: the truth of the contact surface is that of the solids.
void CompareVerdicts(const Verifier& verifier, const ContactSpace& contact,
                     const Trajectory& curve, bool is_clear,
                     CurveTally* tally) {
  ++tally->cases;
  const Verification found = verifier.VerifyCurve(curve);
  tally->seconds += found.seconds;
  tally->undecided += found.verdict == Verdict::kUndecided;
  tally->confirmed += found.verdict == Verdict::kConfirmed;
  tally->refuted += found.verdict == Verdict::kRefuted;
  if (!is_clear) return;
  const CurveTruth truth =
      testing::MeetsSurface(curve.pieces()[0], contact.mesh());
  const bool is_wrong =
      found.verdict == Verdict::kConfirmed ? truth != CurveTruth::kMisses
      : found.verdict == Verdict::kRefuted ? truth == CurveTruth::kMisses
                                           : false;
  tally->wrong += is_wrong;
  EXPECT_FALSE(is_wrong) << found.reason;
}

TEST(CurveVerificationCampaign, AgreesWithRationals) {
  const long each = testing::CampaignCases(40, 2'000);
  CurveTally random_curves, grazing;
  std::mt19937_64 random(3103);
  for (const MeshPair& pair : MeshPairs()) {
    const ContactSpace contact = BuildContactSpace(pair.robot, pair.obstacle);
    const FreeSpace space({contact});
    const Verifier verifier(Of(pair.robot, pair.obstacle));
    for (long i = 0; i < each; ++i) {
      CompareVerdicts(verifier, contact, RandomCurve(space, contact, &random),
                      true, &random_curves);
    }
    for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0, -1e-15,
                             -1e-12, -1e-9, -1e-6, -1e-3}) {
      for (long i = 0; i < each / 10; ++i) {
        const Trajectory curve({testing::GrazingPiece(contact, gap, &random)});
        if (!space.IsFree(curve.pieces()[0].front())) continue;
        // Others are rounded, by less than this.
        const bool is_clear = pair.is_exact || std::abs(gap) > 5e-10;
        CompareVerdicts(verifier, contact, curve, is_clear, &grazing);
      }
    }
  }
  for (const CurveTally& tally : {random_curves, grazing}) {
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_LE(tally.undecided, tally.cases / 500);
    EXPECT_GE(tally.confirmed, tally.cases / 10);
    EXPECT_GE(tally.refuted, tally.cases / 10);
  }
  EXPECT_EQ(random_curves.cases, 6 * each);
  EXPECT_GE(grazing.cases, each);
  testing::ReportCampaign(
      {"verification", "random curves on the solids, rational truth",
       random_curves.cases, random_curves.wrong, 0.0, 0.0, "", 3103});
  testing::ReportCampaign({"verification",
                           "grazing curves on the solids, rational truth",
                           grazing.cases, grazing.wrong, 0.0, 0.0, "", 3103});
}

// A small box where a corner of the robot passes, at any moment.
TEST(CurveVerificationCampaign, FindsWhatIsPlantedOnTheCurve) {
  const long each = testing::CampaignCases(8, 100);
  std::mt19937_64 random(3104);
  std::uniform_real_distribution<double> moment(0.0, 1.0);
  long planted = 0, found = 0;
  for (const MeshPair& pair : MeshPairs()) {
    const ContactSpace contact = BuildContactSpace(pair.robot, pair.obstacle);
    const FreeSpace space({contact});
    const Verifier verifier(Of(pair.robot, pair.obstacle));
    for (long i = 0; i < each; ++i) {
      const Trajectory curve = RandomCurve(space, contact, &random);
      if (!CheckCurve(space, curve).IsFree()) continue;
      EXPECT_EQ(verifier.VerifyCurve(curve).verdict, Verdict::kConfirmed);
      const Vector3d corner =
          pair.robot.vertices[random() % pair.robot.vertices.size()];
      const Vector3d at = corner + curve.At(moment(random)).position;
      for (const double half : {1e-2, 1e-4, 1e-6, 1e-8}) {
        Workspace workspace = Of(pair.robot, pair.obstacle);
        workspace.obstacles.push_back(
            MakeSolid(MakeBox(at - Vector3d::Constant(half),
                              at + Vector3d::Constant(half)),
                      "planted"));
        const Verification answer = Verifier(workspace).VerifyCurve(curve);
        ++planted;
        found += answer.verdict == Verdict::kRefuted;
        EXPECT_EQ(answer.verdict, Verdict::kRefuted) << half;
      }
    }
  }
  EXPECT_GE(planted, 4 * each);
  testing::ReportCampaign({"verification",
                           "small boxes planted on free curves, found", planted,
                           planted - found, 0.0, 0.0, "", 3104});
}

// Curves as users get them, of the contact spaces: confirmed on the solids.
TEST(CurveVerificationCampaign, ConfirmsCurvesOfSceneFamilies) {
  testing::CampaignRow row;
  row.item = "verification";
  row.subject = "curves in time on scene families, on the solids";
  row.unit = "s";
  for (const testing::PlannedScene& planned : testing::PlannedScenes()) {
    const Workspace& workspace = planned.scene.workspace;
    const ContactSpace contact =
        BuildContactSpace(workspace.robot, JoinedObstacle(workspace));
    CurveOptions options;
    options.limits = testing::PlainLimits();
    const CurveSummary curve =
        OptimizeCurve(FreeSpace({contact}, workspace.bounds),
                      contact.bounds().Diagonal(), planned.path, options);
    ASSERT_FALSE(curve.trajectory.empty()) << planned.name;
    ++row.cases;
    const Verification found =
        Verifier(workspace).VerifyCurve(curve.trajectory);
    row.failures += found.verdict == Verdict::kConfirmed ? 0 : 1;
    row.worst = std::max(row.worst, found.seconds);
    EXPECT_EQ(found.verdict, Verdict::kConfirmed)
        << planned.name << ": " << found.reason;
  }
  EXPECT_GE(row.cases, 3 * testing::PlannedSceneSeeds() - 1);
  ReportCampaign(row);
}

}  // namespace
}  // namespace phongpd
