// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: ContactSurfacePlanner on the whole contact space, exact motion checks
// on it, and the judge of proofs on the original solids.
#include "planners/exact/window_planner.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/free_space_flood.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "core/solid/solid.h"
#include "planners/exact/verification.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/random_pairs.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;

// Anywhere about the contact space, or close to its surface: in every cavity.
Vector3d SomePoint(const ContactSpace& space, std::mt19937_64* random) {
  const BoundingBox& box = space.bounds();
  std::uniform_real_distribution<double> share(0.0, 1.0);
  if (share(*random) < 0.5) {
    const Vector3d half = 0.6 * (box.max - box.min);
    return RandomPoint({box.Center() - half, box.Center() + half}, random);
  }
  const TriangleMesh& mesh = space.mesh();
  const std::size_t t = (*random)() % mesh.triangles.size();
  const Triangle& triangle = mesh.triangles[t];
  Vector3d middle = Vector3d::Zero();
  for (const int v : triangle) {
    middle += mesh.vertices[static_cast<std::size_t>(v)] / 3.0;
  }
  return middle + std::pow(10.0, -1.0 - 5.0 * share(*random)) * box.Diagonal() *
                      space.normals()[t];
}

struct PlanTally {
  long plans = 0, wrong = 0, explored = 0, proofs = 0;
};

// Plans between some configurations with both, and judges what comes out.
void ComparePlans(const SolidPair& pair, int trials, std::mt19937_64* random,
                  PlanTally* tally) {
  const ContactSpace space = BuildContactSpace(pair.robot, pair.obstacle);
  const ContactSurfacePlanner whole(space);
  const WindowPlanner planner(ConvolutionModel(pair.robot, pair.obstacle));
  const FreeSpace judge({space});
  Workspace workspace;
  workspace.robot = MakeSolid(pair.robot, "robot");
  workspace.obstacles = {MakeSolid(pair.obstacle, "obstacle")};
  const Verifier verifier(workspace);
  for (int i = 0; i < trials; ++i) {
    const Vector3d a = SomePoint(space, random), b = SomePoint(space, random);
    if (!judge.IsFree(a) || !judge.IsFree(b)) continue;
    const PlanResult expected = whole.Plan(a, b);
    const WindowPlan found = planner.Plan(a, b);
    const PlanResult& plan = found.plan;
    ++tally->plans;
    tally->explored += found.boxes > 0 ? 1 : 0;
    bool is_right = plan.status == expected.status;
    EXPECT_EQ(ToString(plan.status), std::string(ToString(expected.status)))
        << plan.reason << "; " << a.transpose() << " to " << b.transpose();
    if (plan.status == PathStatus::kSolved) {
      is_right = is_right && plan.path.front() == a && plan.path.back() == b &&
                 CheckPath(judge, plan.path).free &&
                 plan.length == PathLength(plan.path);
      EXPECT_NEAR(plan.clearance, PathClearance(judge, plan.path),
                  1e-9 * space.bounds().Diagonal());
    }
    if (plan.status == PathStatus::kInfeasibleProved) {
      ++tally->proofs;
      const Verification proof =
          verifier.VerifySeparation(found.surface->mesh(), a, b);
      is_right = is_right && proof.verdict != Verdict::kRefuted;
      EXPECT_NE(ToString(proof.verdict), std::string("refuted"))
          << proof.reason;
    }
    EXPECT_TRUE(is_right);
    tally->wrong += is_right ? 0 : 1;
  }
}

TEST(WindowPlannerCampaign, AgreesWithTheWholeContactSpace) {
  std::mt19937_64 random(11);
  PlanTally tally;
  const auto& kinds = AllPairKinds();
  const long cases = testing::CampaignCases(80, 2000);
  for (long i = 0; i < cases; ++i) {
    const PairKind kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
    const auto seed = static_cast<std::uint64_t>(i) / kinds.size();
    if (kind == PairKind::kManyBoxes && seed > 1) continue;  // seconds each
    SCOPED_TRACE(Name(kind) + ", seed " + std::to_string(seed));
    ComparePlans(MakeRandomPair(kind, seed), 6, &random, &tally);
  }
  EXPECT_GT(tally.explored, cases);
  EXPECT_GT(tally.proofs, cases / 20);
  testing::CampaignRow row;
  row.item = "window planner";
  row.subject = "status, path and proof against the whole contact space; " +
                std::to_string(tally.proofs) + " proofs";
  row.cases = tally.plans;
  row.failures = tally.wrong;
  testing::ReportCampaign(row);
}

// Solids that touch along an edge: the surface, rounded, leaves slits of 1e-16
// there, through which the shortest way leads and no robot comes.
TEST(WindowPlanner, TakesNoWayThatOnlyRoundingOpened) {
  struct Slit {
    std::uint64_t seed;
    Vector3d start, goal;
  };
  for (const Slit& slit :
       {Slit{101,
             {3.7257472798169129, 0.42737157145226684, 1.1018589125591502},
             {5.2177734351097289, 0.67236397924965474, -0.18260474440787255}},
        Slit{166,
             {1.6850620761546329, -0.42035871285173121, -1.8625378335982101},
             {0.87705621517630361, -1.6634191569591652, -2.5066382541377266}},
        Slit{193,
             {-4.0277192192052764, 4.9698171440143328, -4.9745566858705992},
             {0.74914911038051357, 1.6552099056117267, -1.0681480820083002}}}) {
    const SolidPair pair = MakeRandomPair(PairKind::kEdgeTouch, slit.seed);
    const ConvolutionModel model(pair.robot, pair.obstacle);
    FreeSpaceFlood flood(model, slit.start, slit.goal);
    ASSERT_EQ(flood.Explore(100000), FreeSpaceFlood::Outcome::kMet);
    const PlanResult walled =
        ContactSurfacePlanner(flood.Surface().AsContactSpace())
            .Plan(flood.start(), flood.goal());
    ASSERT_EQ(walled.status, PathStatus::kSolved);
    const WindowPlanner planner(model);
    EXPECT_TRUE(CheckPath(planner.free_space(), walled.path).free) << slit.seed;
    EXPECT_GT(walled.clearance, walled.rounding) << slit.seed;
    const PlanResult found = planner.Plan(slit.start, slit.goal).plan;
    ASSERT_EQ(found.status, PathStatus::kSolved) << found.reason;
    EXPECT_TRUE(CheckPath(planner.free_space(), found.path).free) << slit.seed;
  }
}

SolidPair PairOf(TriangleMesh robot, TriangleMesh obstacle) {
  SolidPair pair;
  pair.robot = std::move(robot);
  pair.obstacle = std::move(obstacle);
  return pair;
}

TEST(WindowPlanner, AgreesOnBodiesWithNarrowPassagesAndCavities) {
  std::mt19937_64 random(5);
  PlanTally tally;
  for (const SolidPair& pair :
       {PairOf(Rotated(MakeStar(0.3, 0.6), GenericRotation()),
               MakeKnot(1.0, 0.12, 40, 8)),
        PairOf(MakeIcoBall(0.3, 1),
               Rotated(MakeVessel(4, 3, 0.8), GenericRotation())),
        PairOf(MakeIcoBall(0.3, 1), MakeVessel(4, 3, 0.0)),
        PairOf(MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1}),
               MakePlateWithHole(4, 1, 1))}) {
    ComparePlans(pair, 25, &random, &tally);
  }
  EXPECT_GT(tally.explored, 40);
  EXPECT_GE(tally.proofs, 1);
}

// A proof costs the smaller cell, a path what is about it: of a large surface
// little is arranged for either.
TEST(WindowPlanner, CostsWhatIsAskedFor) {
  const TriangleMesh robot = MakeIcoBall(0.1, 2);
  TriangleMesh obstacle = Translated(MakeIcoBall(3.0, 5), {8, 0, 0});
  obstacle = Joined(obstacle, MakeVessel(2, 1, 0.0));
  const WindowPlanner planner(ConvolutionModel(robot, obstacle));
  const ContactSpace space = BuildContactSpace(robot, obstacle);
  const double all = static_cast<double>(space.report().arrangement_faces);
  const WindowPlan path = planner.Plan({-2, 0, 0}, {2, 0.1, 0});
  ASSERT_EQ(path.plan.status, PathStatus::kSolved);
  EXPECT_LT(static_cast<double>(path.faces), 0.3 * all);
  for (const bool is_start : {true, false}) {
    const Vector3d in(0, 0, 0), out(-3, 0.2, 0.1);
    const WindowPlan proof =
        planner.Plan(is_start ? in : out, is_start ? out : in);
    ASSERT_EQ(proof.plan.status, PathStatus::kInfeasibleProved);
    EXPECT_LT(static_cast<double>(proof.faces), 0.3 * all);
    // The cavity's wall alone, in which everything touches.
    for (const Vector3d& v : proof.surface->mesh().vertices) {
      EXPECT_LT(v.lpNorm<Eigen::Infinity>(), 1.0);
    }
  }
}

TEST(WindowPlanner, TakesEndsFarAwayAtOnePlaceAndOnWallsOfBoxes) {
  const WindowPlanner planner(
      ConvolutionModel(Cube(1.0), MakeVessel(4, 3, 0.0)));
  for (const double far : {3.0, 1e3, 1e9}) {
    const WindowPlan around = planner.Plan({-far, 0, 0}, {far, 0.25, 0.5});
    ASSERT_EQ(around.plan.status, PathStatus::kSolved) << far;
    EXPECT_EQ(around.plan.path.front(), Vector3d(-far, 0, 0));
    EXPECT_EQ(around.plan.path.back(), Vector3d(far, 0.25, 0.5));
    EXPECT_TRUE(CheckPath(planner.free_space(), around.plan.path).free);
    EXPECT_LT(around.plan.length, 2.0 * far + 8.0);
    EXPECT_EQ(planner.Plan({0, 0, 0}, {far, 0, 0}).plan.status,
              PathStatus::kInfeasibleProved);
  }
  const WindowPlan rest = planner.Plan({0, 0, 0}, {0, 0, 0});
  ASSERT_EQ(rest.plan.status, PathStatus::kSolved);
  EXPECT_EQ(rest.plan.path.size(), 1u);
  EXPECT_EQ(rest.boxes, 0u);
  EXPECT_FALSE(rest.surface);
}

TEST(WindowPlanner, SaysWhatIsWrongWithItsArguments) {
  const WindowPlanner planner(
      ConvolutionModel(Cube(1.0), MakeVessel(4, 3, 0.0)), {},
      [](const Vector3d&) { return std::string("vessel"); });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const WindowPlan blocked = planner.Plan({1.5, 0, 0}, {0, 0, 0});
  EXPECT_EQ(blocked.plan.status, PathStatus::kStartInCollision);
  EXPECT_NE(blocked.plan.reason.find("vessel"), std::string::npos);
  EXPECT_EQ(planner.Plan({0, 0, 0}, {1.5, 0, 0}).plan.status,
            PathStatus::kGoalInCollision);
  EXPECT_EQ(planner.Plan({0, nan, 0}, {0, 0, 0}).plan.reason,
            "start is not finite");
  RouteRequest request;
  request.clearance = -1.0;
  EXPECT_THROW(planner.Plan({0, 0, 0}, {0, 0, 0.1}, request), InputError);
  const ConvolutionModel model(Cube(1.0), MakeVessel(4, 3, 0.0));
  EXPECT_THROW(FreeSpaceFlood(model, {1.5, 0, 0}, {0, 0, 0}), InputError);
}

TEST(WindowPlanner, IsDeterministicOnAnyNumberOfThreads) {
  const WindowPlanner planner(
      ConvolutionModel(Rotated(MakeStar(0.3, 0.6), GenericRotation()),
                       MakeKnot(1.0, 0.12, 40, 8)));
  const auto plan = [&] { return planner.Plan({-4, 0.3, 0}, {4, 0, 0.2}); };
  const WindowPlan expected = plan();
  ASSERT_EQ(expected.plan.status, PathStatus::kSolved);
  std::vector<WindowPlan> found(3);
  std::vector<std::thread> threads;
  for (WindowPlan& one : found) threads.emplace_back([&] { one = plan(); });
  for (std::thread& thread : threads) thread.join();
  for (const WindowPlan& one : found) {
    EXPECT_EQ(one.plan.path, expected.plan.path);
    EXPECT_EQ(one.faces, expected.faces);
  }
}

}  // namespace
}  // namespace phongpd
