// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the curve against every triangle in rationals, and closed forms.
#include "constraints/curve_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/contact/contact_space.h"
#include "problems/shapes/shapes.h"
#include "tests/support/around_cube.h"
#include "tests/support/campaign.h"
#include "tests/support/curve_pieces.h"
#include "tests/support/curve_truth.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Arch;
using testing::AroundCube;
using testing::Cube;
using testing::CurveTruth;
using testing::GrazingPiece;
using testing::RandomPiece;

constexpr double kSpread = 0.15;

TEST(CurveJudge, ProvesAnArchFreeDownToItsResolution) {
  const FreeSpace space = AroundCube();
  for (const double gap : {1.0, 1e-3, 1e-6, 1e-9, 1e-11}) {
    const CurveCheck check = CheckCurve(space, Arch(gap));
    EXPECT_EQ(check.verdict, MotionVerdict::kFree) << gap;
    EXPECT_DOUBLE_EQ(check.free_until, 2.0);
    // Flat contact: two halvings of a parabola bring its hull down to itself.
    EXPECT_LE(check.tests, 300) << gap;
  }
}

TEST(CurveJudge, CallsNoCurveFreeThatTouches) {
  const FreeSpace space = AroundCube();
  const CurveCheck touch = CheckCurve(space, Arch(0.0));
  EXPECT_EQ(touch.verdict, MotionVerdict::kCollides);
  EXPECT_DOUBLE_EQ(touch.time, 1.0);
  EXPECT_EQ(touch.configuration, Vector3d(0.0, 0.0, 1.0));
  EXPECT_FALSE(space.IsFree(touch.configuration));
  for (const double depth : {1e-15, 1e-12, 1e-6, 0.1}) {
    const CurveCheck check = CheckCurve(space, Arch(-depth));
    EXPECT_NE(check.verdict, MotionVerdict::kFree) << depth;
    // It meets the cube at s = ½ ± ½√depth.
    EXPECT_LE(check.free_until, 1.0 - std::sqrt(depth) + 1e-12) << depth;
  }
}

// Any curve within the blur has to be free as well.
TEST(CurveJudge, ProvesNoCurveFreeThatTouchesWithinItsBlur) {
  const FreeSpace space = AroundCube();
  constexpr long kTests = 1'000'000;
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    EXPECT_TRUE(CheckCurve(space, Arch(gap), kTests, 0.9 * gap).IsFree());
    EXPECT_EQ(CheckCurve(space, Arch(gap), kTests, 1.1 * gap).verdict,
              MotionVerdict::kUndecided);
    const auto beside = [](double y) {
      return Trajectory::Along({{-2.0, y, 0.0}, {2.0, y, 0.0}});
    };
    EXPECT_TRUE(
        CheckCurve(space, beside(1.0 + gap), kTests, 0.9 * gap).IsFree());
    EXPECT_FALSE(
        CheckCurve(space, beside(1.0 + gap), kTests, 1.1 * gap).IsFree());
  }
}

TEST(CurveJudge, FindsACollisionThatSamplesMiss) {
  const TriangleMesh wall = MakeBox({-1e-9, -1.0, -1.0}, {1e-9, 1.0, 1.0});
  const FreeSpace space({BuildContactSpace(Cube(1e-9), wall)});
  const Trajectory through({CurvePiece(
      {{-0.7, 0.0, 0.0}, {-0.1, 0.3, 0.2}, {0.2, -0.2, 0.1}, {0.4, 0.1, 0.0}},
      1.0)});
  EXPECT_NE(CheckCurve(space, through).verdict, MotionVerdict::kFree);
}

TEST(CurveJudge, JudgesPolylinesExactly) {
  const FreeSpace space = AroundCube();
  const double beside = std::nextafter(1.0, 2.0);
  const auto along = [](double y) {
    return Trajectory::Along({{-2.0, y, 0.0}, {2.0, y, 0.0}, {2.0, 3.0, 0.0}});
  };
  EXPECT_TRUE(CheckCurve(space, along(beside)).IsFree());
  const CurveCheck touch = CheckCurve(space, along(1.0));
  EXPECT_EQ(touch.verdict, MotionVerdict::kCollides);
  EXPECT_DOUBLE_EQ(touch.time, 0.25);
  EXPECT_EQ(touch.piece, 0);
}

TEST(CurveJudge, HoldsCurvesWithinTheBounds) {
  const BoundingBox bounds = {Vector3d::Constant(-3.0),
                              Vector3d::Constant(3.0)};
  const FreeSpace space = AroundCube(bounds);
  const auto bow = [](double top) {  // its summit is at `top`
    return Trajectory({CurvePiece(
        {{-2.0, 0.0, 1.5}, {0.0, 0.0, 2.0 * top - 1.5}, {2.0, 0.0, 1.5}},
        1.0)});
  };
  EXPECT_TRUE(CheckCurve(space, bow(3.0 - 1e-9)).IsFree());
  const CurveCheck touch = CheckCurve(space, bow(3.0));
  EXPECT_EQ(touch.verdict, MotionVerdict::kCollides);
  EXPECT_EQ(touch.configuration[2], 3.0);
}

TEST(CurveJudge, IsUndecidedWhereItMayLookNoFurther) {
  const FreeSpace space = AroundCube();
  const CurveCheck check = CheckCurve(space, Arch(1e-6), 1);
  EXPECT_EQ(check.verdict, MotionVerdict::kUndecided);
  EXPECT_LT(check.free_until, 1.0);
  EXPECT_EQ(CheckCurve(space, Trajectory()).verdict, MotionVerdict::kUndecided);
}

struct PieceTally {
  long cases = 0, wrong_free = 0, wrong_collision = 0, undecided = 0;
};

void Compare(const FreeSpace& space, const ContactSpace& contact,
             const CurvePiece& piece, PieceTally* tally) {
  if (!space.IsFree(piece.front())) return;
  ++tally->cases;
  const CurveCheck check = CheckCurve(space, Trajectory({piece}));
  const CurveTruth truth = testing::MeetsSurface(piece, contact.mesh());
  if (check.IsFree() && truth != CurveTruth::kMisses) ++tally->wrong_free;
  if (check.verdict == MotionVerdict::kCollides) {
    if (truth == CurveTruth::kMisses) ++tally->wrong_collision;
    EXPECT_FALSE(space.IsFree(check.configuration));
  }
  if (check.verdict == MotionVerdict::kUndecided) ++tally->undecided;
}

std::vector<ContactSpace> ContactSpaces() {
  std::mt19937_64 random(2901);
  std::vector<ContactSpace> spaces = {
      BuildContactSpace(Cube(0.5), Cube(1.5)),
      BuildContactSpace(Cube(0.3), MakeTorus(1.0, 0.4, 20, 12)),
      BuildContactSpace(MakeStar(0.2, 0.5), MakeL(2.0, 0.6, 0.8))};
  for (int i = 0; i < 3; ++i) {
    TriangleMesh voxels = testing::RandomVoxelSolid(4, 0.4, &random);
    const Eigen::Matrix3d turn = testing::RandomRotation(&random);
    if (i > 0) {
      for (Vector3d& p : voxels.vertices) p = turn * p;
    }
    spaces.push_back(BuildContactSpace(Cube(0.4), voxels));
  }
  return spaces;
}

TEST(CurveJudgeCampaign, CallsNothingFreeThatRationalsSeeMeet) {
  const long each = testing::CampaignCases(40, 20'000);
  PieceTally random_pieces, grazing;
  std::mt19937_64 random(2902);
  for (const ContactSpace& contact : ContactSpaces()) {
    const FreeSpace space({contact});
    for (long i = 0; i < each; ++i) {
      Compare(space, contact, RandomPiece(space, contact, kSpread, &random),
              &random_pieces);
    }
    // Truth and judge round q(t) alike only above some ulps.
    for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0, -1e-15,
                             -1e-12, -1e-9, -1e-6, -1e-3}) {
      for (long i = 0; i < each / 10; ++i) {
        Compare(space, contact, GrazingPiece(contact, gap, &random), &grazing);
      }
    }
  }
  EXPECT_EQ(random_pieces.wrong_free, 0);
  EXPECT_EQ(random_pieces.wrong_collision, 0);
  EXPECT_EQ(grazing.wrong_free, 0);
  EXPECT_LE(random_pieces.undecided, random_pieces.cases / 1000);
  EXPECT_GE(random_pieces.cases, 6 * each);
  EXPECT_GE(grazing.cases, each);
  testing::ReportCampaign(
      {"5 exact motion checks", "random pieces of curves, rational truth",
       random_pieces.cases, random_pieces.wrong_free, 0.0, 0.0, "", 2902});
  testing::ReportCampaign(
      {"5 exact motion checks", "grazing pieces of curves, rational truth",
       grazing.cases, grazing.wrong_free, 0.0, 0.0, "", 2902});
}

TEST(CurveJudge, AnswersTheSameOfConvolutions) {
  const TriangleMesh robot = MakeStar(0.2, 0.5),
                     obstacle = MakeL(2.0, 0.6, 0.8);
  const ContactSpace contact = BuildContactSpace(robot, obstacle);
  const FreeSpace whole({contact});
  const FreeSpace lazy =
      FreeSpace::OfConvolutions({ConvolutionModel(robot, obstacle)});
  std::mt19937_64 random(2903);
  int free = 0;
  for (int i = 0; i < 300; ++i) {
    const Trajectory curve({RandomPiece(whole, contact, kSpread, &random)});
    const MotionVerdict verdict = CheckCurve(whole, curve).verdict;
    EXPECT_EQ(CheckCurve(lazy, curve).verdict, verdict) << i;
    free += verdict == MotionVerdict::kFree;
  }
  EXPECT_GE(free, 30);
  EXPECT_LE(free, 270);
}

}  // namespace
}  // namespace phongpd
