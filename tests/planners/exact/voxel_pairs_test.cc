// SPDX-License-Identifier: GPL-3.0-or-later
// Solids of cubes, where everything touches: the complete planner on the whole
// contact space, the one in windows, and the second opinion on both.  Truth:
// flood fill of the lattice.
#include <gtest/gtest.h>

#include <exception>
#include <random>
#include <sstream>
#include <string>

#include "constraints/motion_oracle.h"
#include "core/contact/contact_space.h"
#include "core/contact/depth.h"
#include "core/mesh/mesh_io.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/verification.h"
#include "planners/exact/window_planner.h"
#include "tests/support/campaign.h"
#include "tests/support/flood_truth.h"
#include "tests/support/voxel_pair.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::CampaignCases;
using testing::VoxelPair;

constexpr std::uint64_t kSeed = 29;

// Both planners on one pair, and their judge.
struct Planners {
  Planners(const Solid& robot, const Solid& obstacle)
      : space(BuildContactSpace(robot, obstacle)),
        full(space, testing::LeastSettings()),
        window(ConvolutionModel(robot, obstacle), testing::LeastSettings()),
        verifier(Workspace{robot, {obstacle}}) {}

  // What is wrong with an answer, or nothing.
  std::string Judge(const PlanResult& plan, const TriangleMesh* surface,
                    const Vector3d& start, const Vector3d& goal,
                    PathStatus truth) const {
    if (plan.status != truth) {
      return std::string(ToString(plan.status)) + " instead of " +
             ToString(truth) + ": " + plan.reason;
    }
    if (plan.status == PathStatus::kSolved) {
      if (plan.path.front() != start || plan.path.back() != goal) {
        return "other ends";
      }
      const Verification path = verifier.VerifyPath(plan.path);
      return path.verdict == Verdict::kRefuted ? path.reason : "";
    }
    if (plan.status == PathStatus::kInfeasibleProved) {
      const Verification proof =
          verifier.VerifySeparation(*surface, start, goal);
      return proof.verdict == Verdict::kConfirmed ? "" : proof.reason;
    }
    return "";
  }
  std::string JudgeFull(const Vector3d& start, const Vector3d& goal,
                        PathStatus truth) const {
    try {
      return Judge(full.Plan(start, goal), &space.mesh(), start, goal, truth);
    } catch (const std::exception& error) {
      return std::string("internal error: ") + error.what();
    }
  }
  std::string JudgeWindow(const Vector3d& start, const Vector3d& goal,
                          PathStatus truth) const {
    try {
      const WindowPlan found = window.Plan(start, goal);
      return Judge(found.plan, found.surface ? &found.surface->mesh() : nullptr,
                   start, goal, truth);
    } catch (const std::exception& error) {
      return std::string("internal error: ") + error.what();
    }
  }

  ContactSpace space;
  ContactSurfacePlanner full;
  WindowPlanner window;
  Verifier verifier;
};

class VoxelPairsCampaign : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Kinds, VoxelPairsCampaign,
                         ::testing::Range(0, VoxelPair::kKinds));

// In the long form a million queries in 2,400 worlds.
TEST_P(VoxelPairsCampaign, FullAndWindowAnswerAsTheFloodFillTells) {
  const long pairs = CampaignCases(8, 400), queries = CampaignCases(8, 420);
  std::string kind;
  long asked = 0, solved = 0, proved = 0, invalid = 0, failures = 0;
  const auto count = [&](const std::string& wrong, const std::string& what) {
    if (wrong.empty()) return;
    if (++failures <= 20) ADD_FAILURE() << what << ": " << wrong;
  };
  for (long i = 0; i < pairs; ++i) {
    const auto seed =
        kSeed + static_cast<std::uint64_t>(10000 * GetParam() + i);
    std::mt19937_64 random(seed);
    const VoxelPair pair = testing::MakeVoxelPair(
        static_cast<VoxelPair::Kind>(GetParam()), &random);
    kind = pair.name;
    const Planners planners(pair.robot, pair.obstacle);
    for (long k = 0; k < queries; ++k) {
      const VoxelPair::Quarters from = pair.RandomPoint(&random);
      const VoxelPair::Quarters to = pair.RandomPoint(&random);
      const int at_from = pair.Label(from), at_to = pair.Label(to);
      const PathStatus truth = testing::FloodTruth(at_from, at_to);
      const Vector3d start = pair.Point(from), goal = pair.Point(to);
      std::ostringstream what;
      what.precision(17);
      what << pair.name << ", seed " << seed << ", (" << start.transpose()
           << ") to (" << goal.transpose() << ")";
      count(planners.JudgeFull(start, goal, truth), "full, " + what.str());
      count(planners.JudgeWindow(start, goal, truth), "window, " + what.str());
      ++asked;
      solved += truth == PathStatus::kSolved;
      proved += truth == PathStatus::kInfeasibleProved;
      invalid += at_from < 0 || at_to < 0;
    }
  }
  EXPECT_EQ(failures, 0);
  EXPECT_GT(solved, asked / 4);
  EXPECT_GT(proved, asked / 100);
  EXPECT_GT(invalid, asked / 100);
  testing::CampaignRow row;
  row.item = "voxel pairs";
  row.subject = GetParam() == static_cast<int>(VoxelPair::Kind::kMerged)
                    ? "merged"
                    : kind;
  row.subject += ": full, window and flood fill in " + std::to_string(pairs) +
                 " worlds; " + std::to_string(proved) + " proofs";
  row.cases = asked;
  row.failures = failures;
  row.seed = kSeed;
  testing::ReportCampaign(row);
}

Solid Fault(const std::string& name) {
  return MakeSolid(ReadMesh(std::string(PHONGPD_TEST_DATA) + "/faults/" + name),
                   name);
}

// The box of an end was arranged twice, and the second time its rooms had other
// numbers: a free end was looked for in a wall.
TEST(VoxelPairs, KeepTheRoomsThatTheirEndsAreIn) {
  const Planners planners(Fault("rooms_robot.off"),
                          Fault("rooms_obstacle.off"));
  EXPECT_EQ(planners.JudgeWindow({-4.25, -0.5, 1.5}, {1.75, 0.5, 1.5},
                                 PathStatus::kInfeasibleProved),
            "");
}

// Two free cells touch in an edge of the contact surface, which was one closed
// part for the judge: around both ends as often.
TEST(VoxelPairs, ConfirmProofsWhereCellsTouchInAnEdge) {
  const Planners planners(Fault("cells_robot.off"),
                          Fault("cells_obstacle.off"));
  const Vector3d start(3.5, 0.5, 2), goal(5.5, 0.5, 6.5);
  EXPECT_EQ(planners.JudgeFull(start, goal, PathStatus::kInfeasibleProved), "");
  EXPECT_EQ(planners.JudgeWindow(start, goal, PathStatus::kInfeasibleProved),
            "");
}

// Free against the explored surface, whose corners are rounded, the way grazed
// an edge that the model knows exactly: closed, and nothing else was tried.
TEST(VoxelPairs, BendAsideWhereRoundingClosesAWay) {
  struct Case {
    std::uint64_t seed;
    Vector3d start, goal;
  };
  for (const Case& c :
       {Case{20104, {-11.5, 31.5, -13}, {-6, -8, 20}},
        Case{20178, {1.25, -24.25, -25.25}, {-13.75, -40, -37.5}}}) {
    std::mt19937_64 random(c.seed);
    const VoxelPair pair =
        testing::MakeVoxelPair(VoxelPair::Kind::kSheared, &random);
    const Planners planners(pair.robot, pair.obstacle);
    EXPECT_EQ(planners.JudgeWindow(c.start, c.goal, PathStatus::kSolved), "")
        << c.seed;
  }
}

// All coordinates are multiples of three, halves of one are not.
TEST(VoxelPairs, TouchWhereTheLatticesUnitIsNoPowerOfTwo) {
  const Planners planners(Fault("thirds_robot.off"),
                          Fault("thirds_obstacle.off"));
  EXPECT_EQ(planners.JudgeWindow({-27, -3, -6}, {-18.5, 8.5, -8},
                                 PathStatus::kGoalInCollision),
            "");
}

// Places where a vertex of one lies in a facet, an edge or a vertex of the
// other, on lattices of any unit.
TEST(VoxelPairs, TouchingIsCollisionForEveryModel) {
  int touching = 0;
  for (int i = 0; i < 12; ++i) {
    std::mt19937_64 random(kSeed + static_cast<std::uint64_t>(i));
    const VoxelPair pair = testing::MakeVoxelPair(
        i % 2 == 0 ? VoxelPair::Kind::kSheared : VoxelPair::Kind::kScaled,
        &random);
    const ConvolutionModel model(pair.robot, pair.obstacle);
    const DepthQuery depth(pair.robot, pair.obstacle);
    const MotionOracle truth(pair.robot, pair.obstacle);
    const auto corner_of = [&](const TriangleMesh& mesh) -> Vector3d {
      return mesh.vertices[random() % mesh.vertices.size()];
    };
    const auto place_on = [&](const TriangleMesh& mesh) {
      const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
      const int a = static_cast<int>(random() % 9);
      const int b = static_cast<int>(random() % static_cast<unsigned>(9 - a));
      Vector3d sum = Vector3d::Zero();
      const int weights[] = {a, b, 8 - a - b};
      for (std::size_t k = 0; k < 3; ++k) {
        sum += weights[k] * mesh.vertices[static_cast<std::size_t>(t[k])] / 8.0;
      }
      return sum;
    };
    for (int k = 0; k < 100; ++k) {
      const Vector3d q =
          k % 2 == 0
              ? Vector3d(place_on(pair.obstacle) - corner_of(pair.robot))
              : Vector3d(corner_of(pair.obstacle) - place_on(pair.robot));
      EXPECT_TRUE(truth.Collides(q));
      EXPECT_FALSE(model.IsFree(q)) << pair.name << " at " << q.transpose();
      const DepthStatus status = depth.At(q).status;
      EXPECT_NE(status, DepthStatus::kSeparate)
          << pair.name << " at " << q.transpose();
      touching += status == DepthStatus::kTouching;
    }
  }
  EXPECT_GT(touching, 100);
}

}  // namespace
}  // namespace phongpd
