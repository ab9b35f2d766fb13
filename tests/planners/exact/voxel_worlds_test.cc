// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: flood fill, and the exact motion checks of FreeSpace.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "constraints/free_space.h"
#include "planners/exact/contact_roadmap.h"
#include "planners/exact/contact_surface_planner.h"
#include "tests/support/solid_tools.h"
#include "tests/support/voxel_world.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::MakeVoxelWorld;
using testing::VoxelWorld;

struct WorldTally {
  int solved = 0, proved = 0, wrong = 0, searches = 0;
  int worlds = 0;
  long queries = 0, lazy_searches = 0;  // of every third's roadmap
  double least_clearance = 1e9;         // in channel widths
  double slowest = 0.0;
};

// The roadmap on several pairs, as it is and shortened.
void TryRoadmap(const VoxelWorld& world,
                std::shared_ptr<const ContactSurfacePlanner> planner,
                const std::vector<Vector3d>& centers, std::size_t i,
                WorldTally* tally) {
  const ContactRoadmap roadmap(std::move(planner));
  const FreeSpace space({TakeAsContactSpace(world.contact_space)});
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t j = (i + k * k) % centers.size();
    RoadmapRequest request;
    request.shorten = k % 2 == 0;
    const PlanResult result = roadmap.Plan(centers[i], centers[j], request);
    const bool connected = world.labels[i] == world.labels[j];
    EXPECT_EQ(ToString(result.status),
              std::string(connected ? "solved" : "infeasible_proved"))
        << result.reason;
    const bool is_right = connected
                              ? result.status == PathStatus::kSolved &&
                                    CheckPath(space, result.path).free &&
                                    result.path.front() == centers[i] &&
                                    result.path.back() == centers[j]
                              : result.status == PathStatus::kInfeasibleProved;
    EXPECT_TRUE(is_right);
    tally->wrong += !is_right;
  }
  tally->queries += roadmap.report().queries;
  tally->lazy_searches += roadmap.report().lazy_searches;
}

// One random pair of cells of one random world, moved by x → scale·R·x + t.
void Try(std::mt19937_64* random, const Eigen::Matrix3d& rotation, double scale,
         double offset, WorldTally* tally) {
  static constexpr double kFills[] = {0.1, 0.35, 0.5, 0.62};
  static constexpr double kChannels[] = {0.3, 0.05, 1e-4};
  const double channel = kChannels[(*random)() % 3];
  const double fill = kFills[(*random)() % 4];
  const bool filled_around = (*random)() % 2 == 0;
  const int n = 3 + static_cast<int>((*random)() % 3);
  VoxelWorld world = MakeVoxelWorld(n, fill, channel, filled_around, random);
  if (world.centers.empty()) return;
  const auto move = [&](const Vector3d& x) -> Vector3d {
    return scale * (rotation * x) + Vector3d::Constant(offset);
  };
  for (Vector3d& v : world.contact_space.vertices) v = move(v);
  const std::size_t i = (*random)() % world.centers.size();
  const std::size_t j = (*random)() % world.centers.size();
  std::vector<Vector3d> centers;
  for (const Vector3d& center : world.centers) centers.push_back(move(center));
  const Vector3d& start = centers[i];
  const Vector3d& goal = centers[j];
  const bool connected = world.labels[i] == world.labels[j];

  const auto planner = std::make_shared<const ContactSurfacePlanner>(
      TakeAsContactSpace(world.contact_space));
  if (tally->worlds++ % 3 == 0) {
    TryRoadmap(world, planner, centers, i, tally);
  }
  const PlanResult result = planner->Plan(start, goal);
  tally->searches = std::max(tally->searches, result.searches);
  tally->slowest = std::max(tally->slowest, result.seconds);
  EXPECT_EQ(ToString(result.status),
            std::string(connected ? "solved" : "infeasible_proved"))
      << result.reason << " n " << n << " fill " << fill << " channel "
      << channel << " around " << filled_around;
  if (connected != (result.status == PathStatus::kSolved)) ++tally->wrong;
  if (result.status != PathStatus::kSolved) {
    tally->proved += result.status == PathStatus::kInfeasibleProved;
    return;
  }
  ++tally->solved;
  const FreeSpace space({TakeAsContactSpace(world.contact_space)});
  EXPECT_TRUE(CheckPath(space, result.path).free);
  EXPECT_TRUE(CheckPath(space, result.raw_path).free);
  EXPECT_EQ(result.path.front(), start);
  EXPECT_EQ(result.path.back(), goal);
  tally->least_clearance =
      std::min(tally->least_clearance, result.clearance / (scale * channel));
}

// PHONGPD_VOXEL_WORLDS=1700 makes it 5,100 worlds.
int Worlds(int in_the_suite) {
  const char* wanted = std::getenv("PHONGPD_VOXEL_WORLDS");
  return wanted != nullptr ? std::atoi(wanted) : in_the_suite;
}

void Report(const WorldTally& tally) {
  std::printf(
      "solved %d proved %d wrong %d searches %d clearance/channel %g "
      "slowest %g s roadmap %ld lazy %ld\n",
      tally.solved, tally.proved, tally.wrong, tally.searches,
      tally.least_clearance, tally.slowest, tally.queries, tally.lazy_searches);
}

TEST(ContactSurfacePlanner, AgreesWithFloodFillInVoxelWorlds) {
  std::mt19937_64 random(1);
  WorldTally tally;
  for (int i = 0; i < Worlds(300); ++i) {
    Try(&random, Eigen::Matrix3d::Identity(), 1.0, 0.0, &tally);
  }
  Report(tally);
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_GT(tally.solved, 30);
  EXPECT_GT(tally.proved, 30);
}

TEST(ContactSurfacePlanner, AgreesWithFloodFillInTurnedVoxelWorlds) {
  std::mt19937_64 random(2);
  WorldTally tally;
  for (int i = 0; i < Worlds(200); ++i) {
    Try(&random, testing::RandomRotation(&random), 1.0, 0.0, &tally);
  }
  Report(tally);
  EXPECT_EQ(tally.wrong, 0);
}

TEST(ContactSurfacePlanner, AgreesWithFloodFillAtAllScalesAndOffsets) {
  std::mt19937_64 random(3);
  static constexpr double kScales[] = {1e-3, 1.0, 1e3};
  static constexpr double kOffsets[] = {0.0, 1e3, 1e5};
  WorldTally tally;
  for (int i = 0; i < Worlds(90); ++i) {
    const double scale = kScales[i % 3];
    Try(&random, testing::RandomRotation(&random), scale,
        kOffsets[i / 3 % 3] * scale, &tally);
  }
  Report(tally);
  EXPECT_EQ(tally.wrong, 0);
}

}  // namespace
}  // namespace phongpd
