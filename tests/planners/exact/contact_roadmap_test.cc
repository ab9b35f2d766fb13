// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: how the scenes are made, FreeSpace, and ContactSurfacePlanner.
// voxel_worlds_test compares with flood fill.
#include "planners/exact/contact_roadmap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "planners/world/workspace.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/scene_library.h"
#include "problems/shapes/shapes.h"
#include "tests/support/path_problems.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::VesselSpace;
using Knobs = std::map<std::string, double>;

struct Problem {
  Problem(const std::string& family, const Knobs& knobs,
          const ContactSpaceOptions& options = {})
      : scene(ParseScene(MakeScene(family, knobs), family)),
        contact(BuildContactSpace(scene.workspace.robot,
                                  MergedObstacle(scene.workspace), options)),
        space({contact}),
        planner(std::make_shared<const ContactSurfacePlanner>(contact)),
        roadmap(planner) {}

  // Free configurations within the bounds.
  std::vector<Vector3d> RandomPoints(int count, std::uint64_t seed) const {
    const BoundingBox& box = contact.bounds();
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<Vector3d> points;
    while (static_cast<int>(points.size()) < count) {
      const Vector3d s(share(random), share(random), share(random));
      const Vector3d q = box.min + s.cwiseProduct(box.max - box.min);
      CellRay ray;
      if (space.IsFree(q) &&
          planner->cells().CellOf(q, &ray) != FreeCells::kOutside) {
        points.push_back(q);
      }
    }
    return points;
  }

  Scene scene;
  ContactSpace contact;
  FreeSpace space;
  std::shared_ptr<const ContactSurfacePlanner> planner;
  ContactRoadmap roadmap;
};

constexpr const char* kFamilies[] = {"hole",  "tunnel",  "keyhole",
                                     "snake", "bugtrap", "maze"};

// The path is exactly free, from start to goal, and measured right.
void ExpectRight(const PlanResult& result, const Problem& problem,
                 const Vector3d& start, const Vector3d& goal) {
  ASSERT_EQ(result.status, PathStatus::kSolved) << result.reason;
  EXPECT_TRUE(CheckPath(problem.space, result.path).free);
  EXPECT_TRUE(CheckPath(problem.space, result.raw_path).free);
  for (const auto* path : {&result.path, &result.raw_path}) {
    EXPECT_EQ(path->front(), start);
    EXPECT_EQ(path->back(), goal);
  }
  EXPECT_NEAR(result.length, PathLength(result.path), 1e-12);
  EXPECT_NEAR(result.clearance, PathClearance(problem.space, result.path),
              1e-9 * result.clearance);
}

TEST(ContactRoadmap, PassesWhateverIsWideEnough) {
  for (const double rotation : {0.0, 5.0}) {
    for (const double delta : {2e-2, 1e-3, 2e-5}) {
      for (const char* family : kFamilies) {
        const Problem problem(family,
                              {{"delta", delta}, {"rotation_seed", rotation}});
        const Vector3d& start = problem.scene.start;
        const Vector3d& goal = problem.scene.goal;
        const PlanResult result = problem.roadmap.Plan(start, goal);
        SCOPED_TRACE(family + std::to_string(delta));
        ExpectRight(result, problem, start, goal);
        // Possible are δ/2.
        EXPECT_GT(result.clearance, 0.35 * 0.5 * delta);
        EXPECT_LT(result.length,
                  1.15 * problem.planner->Plan(start, goal).length);
        EXPECT_EQ(problem.roadmap.report().lazy_searches, 0);
      }
    }
  }
}

TEST(ContactRoadmap, ProvesThatTwinsAreInfeasible) {
  for (const double rotation : {0.0, 5.0}) {
    for (const char* family : kFamilies) {
      const Problem problem(family,
                            {{"twin", 1.0}, {"rotation_seed", rotation}});
      const PlanResult result =
          problem.roadmap.Plan(problem.scene.start, problem.scene.goal);
      EXPECT_EQ(result.status, PathStatus::kInfeasibleProved) << family;
      EXPECT_NE(result.start.cell, result.goal.cell) << family;
      EXPECT_FALSE(result.start.rays.empty() && result.goal.rays.empty());
      EXPECT_EQ(result.self_intersections, 0) << family;
      EXPECT_EQ(problem.roadmap.report().queries, 0);
    }
  }
}

TEST(ContactRoadmap, AnswersHundredsOfQueriesLikeThePlanner) {
  // Two rooms and keyholes between them, closed in the twin.
  for (const double twin : {0.0, 1.0}) {
    const Problem problem(
        "keyhole", {{"delta", 1e-3}, {"twin", twin}, {"rotation_seed", 1.0}});
    const std::vector<Vector3d> points = problem.RandomPoints(400, 7);
    int solved = 0, proved = 0, detours = 0;
    for (std::size_t i = 0; i < points.size(); i += 2) {
      const Vector3d& start = points[i];
      const Vector3d& goal = points[i + 1];
      const PlanResult found = problem.roadmap.Plan(start, goal);
      const PlanResult expected = problem.planner->Plan(start, goal);
      ASSERT_EQ(found.status, expected.status) << i << found.reason;
      EXPECT_EQ(found.start.cell, expected.start.cell);
      EXPECT_EQ(found.goal.cell, expected.goal.cell);
      if (found.status != PathStatus::kSolved) {
        ++proved;
        continue;
      }
      ++solved;
      detours += found.path.size() > 2;
      ExpectRight(found, problem, start, goal);
      EXPECT_LT(found.length, 1.5 * expected.length);
    }
    EXPECT_EQ(solved + proved, 200);
    EXPECT_EQ(proved == 0, twin == 0.0);
    EXPECT_EQ(proved > 40, twin == 1.0);
    EXPECT_EQ(detours > 40, twin == 0.0) << detours;
    EXPECT_EQ(problem.roadmap.report().queries, solved);
    EXPECT_EQ(problem.roadmap.report().lazy_searches, 0);
  }
}

TEST(ContactRoadmap, GivesItsRouteAsItIsOnRequest) {
  const Problem problem("clutter_hole", {{"delta", 1e-3}});
  RoadmapRequest raw;
  raw.shorten = false;
  for (const Vector3d& goal : problem.RandomPoints(20, 3)) {
    const Vector3d& start = problem.scene.start;
    const PlanResult route = problem.roadmap.Plan(start, goal, raw);
    ExpectRight(route, problem, start, goal);
    EXPECT_EQ(route.path, route.raw_path);
    EXPECT_EQ(route.routes.size(), 1u);
    const PlanResult result = problem.roadmap.Plan(start, goal);
    EXPECT_EQ(result.raw_path, route.path);
    EXPECT_LE(result.length, 1.02 * route.length);
  }
}

TEST(ContactRoadmap, KeepsTheClearanceARequestWants) {
  // Around a cube with side 2, at least as far from it as wanted.
  const TriangleMesh cube =
      MakeBox(Vector3d::Constant(-1.0), Vector3d::Constant(1.0));
  const ContactRoadmap roadmap(TakeAsContactSpace(cube));
  const FreeSpace space({TakeAsContactSpace(cube)});
  for (const double wanted : {0.01, 0.1, 0.3}) {
    RoadmapRequest request;
    request.clearance = wanted;
    const PlanResult result =
        roadmap.Plan({-3.0, 0.1, 0.2}, {3.0, 0.0, 0.1}, request);
    ASSERT_EQ(result.status, PathStatus::kSolved);
    EXPECT_EQ(result.wanted_clearance, wanted);
    EXPECT_GT(PathClearance(space, result.path), 0.5 * wanted) << wanted;
  }
}

TEST(ContactRoadmap, CopesWithNeedles) {
  ContactSpaceOptions as_arranged;
  as_arranged.merge_coplanar = false;
  for (const char* family : {"keyhole", "snake", "clutter_hole"}) {
    for (const double twin : {0.0, 1.0}) {
      const Problem problem(
          family, {{"delta", 1e-3}, {"twin", twin}, {"rotation_seed", 4.0}},
          as_arranged);
      const PlanResult result =
          problem.roadmap.Plan(problem.scene.start, problem.scene.goal);
      EXPECT_EQ(result.status, twin == 0.0 ? PathStatus::kSolved
                                           : PathStatus::kInfeasibleProved)
          << family << ": " << result.reason;
      if (twin == 0.0) {
        ExpectRight(result, problem, problem.scene.start, problem.scene.goal);
      }
    }
  }
}

TEST(ContactRoadmap, SolvesAtAllScalesAndOffsets) {
  for (const double scale : {1e-3, 1e3}) {
    for (const double offset : {0.0, 1e5}) {
      const Problem problem("tunnel", {{"delta", 1e-4},
                                       {"scale", scale},
                                       {"offset", offset * scale},
                                       {"rotation_seed", 2.0}});
      const PlanResult result =
          problem.roadmap.Plan(problem.scene.start, problem.scene.goal);
      EXPECT_EQ(result.status, PathStatus::kSolved) << result.reason;
      EXPECT_TRUE(CheckPath(problem.space, result.path).free);
      EXPECT_EQ(problem.roadmap.report().lazy_searches, 0);
    }
  }
}

// A channel narrower than the rounding of coordinates: no edge through it can
// be lifted beforehand.
TEST(ContactRoadmap, AsksThePlannerWhereRoundingClosedItsRoutes) {
  const Problem problem("hole", {{"delta", 1e-9}, {"offset", 1e5}});
  const Vector3d& start = problem.scene.start;
  const Vector3d& goal = problem.scene.goal;
  const PlanResult result = problem.roadmap.Plan(start, goal);
  const PlanResult expected = problem.planner->Plan(start, goal);
  EXPECT_EQ(problem.roadmap.report().lazy_searches, 1);
  EXPECT_GT(problem.roadmap.report().left_out_edges, 0);
  EXPECT_EQ(expected.status, PathStatus::kSolved);
  EXPECT_EQ(result.status, expected.status);
  EXPECT_EQ(result.path, expected.path);
  EXPECT_EQ(result.searches, expected.searches);
  EXPECT_TRUE(CheckPath(problem.space, result.path).free);
}

TEST(ContactRoadmap, AnswersAtTheLimitsOfFreeSpace) {
  const ContactRoadmap roadmap(TakeAsContactSpace(VesselSpace()));
  const Vector3d free(0.5, 0.25, 0.125);
  // Nowhere to go, and straight ahead.
  PlanResult result = roadmap.Plan(free, free);
  EXPECT_EQ(result.path, std::vector<Vector3d>{free});
  EXPECT_EQ(result.length, 0.0);
  result = roadmap.Plan(free, -free);
  EXPECT_EQ(result.path, (std::vector<Vector3d>{free, -free}));
  // Not free.
  EXPECT_EQ(roadmap.Plan({2.0, 0.0, 0.0}, free).status,
            PathStatus::kStartInCollision);
  result = roadmap.Plan(free, {0.0, 2.5, 0.0});
  EXPECT_EQ(result.status, PathStatus::kGoalInCollision);
  EXPECT_EQ(result.reason, "goal is 0.5 deep in an obstacle");
  EXPECT_EQ(roadmap.Plan({std::nan(""), 0.0, 0.0}, free).status,
            PathStatus::kStartInCollision);
  // Out of it, and a whisker from contact on both sides of a corner.
  EXPECT_EQ(roadmap.Plan(free, {8.0, 0.0, 0.0}).status,
            PathStatus::kInfeasibleProved);
  for (const double near : {1e-3, 1e-9, 1e-13}) {
    const Vector3d start(-6.0 - near, 0.3, 0.2), goal(0.1, 6.0 + near, -5.0);
    result = roadmap.Plan(start, goal);
    ASSERT_EQ(result.status, PathStatus::kSolved) << near << result.reason;
    EXPECT_TRUE(
        CheckPath(FreeSpace({TakeAsContactSpace(VesselSpace())}), result.path)
            .free);
  }
  // Far away.
  result = roadmap.Plan({-1e6, 0.1, 0.2}, {1e6, 0.0, 0.0});
  EXPECT_EQ(result.status, PathStatus::kSolved);
  EXPECT_LT(result.length, 2.1e6);
  EXPECT_EQ(roadmap.report().lazy_searches, 0);
}

TEST(ContactRoadmap, JoinsIslandsSideBySideThroughTheOutside) {
  // No ray leads from one to the other; start and goal touch either.
  const TriangleMesh mesh =
      Joined(MakeBox({0, 0, 0}, {1, 1, 1}), MakeBox({9, -7, 0}, {10, -6, 1}));
  const ContactRoadmap roadmap(TakeAsContactSpace(mesh));
  const PlanResult result =
      roadmap.Plan({-0.001, 0.5, 0.5}, {10.001, -6.5, 0.5});
  EXPECT_EQ(result.status, PathStatus::kSolved);
  EXPECT_EQ(roadmap.report().lazy_searches, 0);
}

TEST(ContactRoadmap, AnswersTheSameFromSeveralThreadsAndWhenRebuilt) {
  const Problem problem("clutter_hole",
                        {{"delta", 1e-3}, {"rotation_seed", 3.0}});
  const std::vector<Vector3d> points = problem.RandomPoints(60, 11);
  const auto answer = [&](const ContactRoadmap& roadmap) {
    std::vector<std::vector<Vector3d>> paths;
    for (std::size_t i = 0; i < points.size(); i += 2) {
      const PlanResult result = roadmap.Plan(points[i], points[i + 1]);
      paths.push_back(result.path);
      paths.push_back(result.raw_path);
    }
    return paths;
  };
  const auto expected = answer(problem.roadmap);
  EXPECT_EQ(answer(ContactRoadmap(problem.contact)), expected);
  std::vector<std::vector<std::vector<Vector3d>>> found(4);
  std::vector<std::thread> threads;
  for (auto& paths : found) {
    threads.emplace_back([&] { paths = answer(problem.roadmap); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& paths : found) EXPECT_EQ(paths, expected);
}

TEST(ContactRoadmap, RefusesOptionsAndRequestsOutOfRange) {
  const ContactSpace vessel = TakeAsContactSpace(VesselSpace());
  const auto planner = std::make_shared<const ContactSurfacePlanner>(vessel);
  for (const double spacing : {0.0, 2.0, std::nan("")}) {
    EXPECT_THROW(ContactRoadmap(planner, spacing), InputError) << spacing;
  }
  EXPECT_THROW(ContactRoadmap(std::shared_ptr<const ContactSurfacePlanner>()),
               InputError);
  const ContactRoadmap roadmap(vessel);
  RoadmapRequest request;
  request.clearance = -1.0;
  EXPECT_THROW(roadmap.Plan({0, 0, 0}, {1, 0, 0}, request), InputError);
  request.clearance = std::numeric_limits<double>::infinity();
  EXPECT_THROW(roadmap.Plan({0, 0, 0}, {1, 0, 0}, request), InputError);
}

// Bare: a roadmap of the least size is as complete.
TEST(ContactRoadmap, SolvesWithTheLeastOptions) {
  for (const char* family : kFamilies) {
    const Problem problem(family, {{"delta", 1e-4}});
    const ContactRoadmap roadmap(problem.planner, 1.0);
    EXPECT_LT(roadmap.report().nodes, problem.roadmap.report().nodes);
    const PlanResult result =
        roadmap.Plan(problem.scene.start, problem.scene.goal);
    ExpectRight(result, problem, problem.scene.start, problem.scene.goal);
    EXPECT_EQ(roadmap.report().lazy_searches, 0) << family;
  }
}

}  // namespace
}  // namespace phongpd
