// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: how the scenes are made, FreeSpace, and closed forms.
#include "planners/exact/contact_surface_planner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "constraints/free_space.h"
#include "core/bvh/triangle_bvh.h"
#include "core/solid/solid.h"
#include "planners/exact/path_shortening.h"
#include "planners/exact/planning_surface.h"
#include "planners/world/workspace.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/scene_library.h"
#include "problems/shapes/shapes.h"
#include "tests/support/path_problems.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::VesselSpace;
using Knobs = std::map<std::string, double>;

// Plans a scene, checks the path and returns the result.
PlanResult PlanScene(const std::string& family, const Knobs& knobs) {
  const Scene scene = ParseScene(MakeScene(family, knobs), family);
  const TriangleMesh contact =
      BuildContactSpace(scene.workspace.robot, MergedObstacle(scene.workspace))
          .mesh();
  const PlanResult result = ContactSurfacePlanner(TakeAsContactSpace(contact))
                                .Plan(scene.start, scene.goal);
  if (result.status != PathStatus::kSolved) return result;
  const FreeSpace space({TakeAsContactSpace(contact)});
  EXPECT_TRUE(CheckPath(space, result.path).free) << family;
  EXPECT_TRUE(CheckPath(space, result.raw_path).free) << family;
  EXPECT_EQ(result.path.front(), scene.start);
  EXPECT_EQ(result.path.back(), scene.goal);
  EXPECT_NEAR(result.length, PathLength(result.path), 1e-12);
  EXPECT_NEAR(result.clearance, PathClearance(space, result.path),
              1e-9 * result.clearance)
      << family;
  // The way through the middle, made as short as exact tests allow.
  if (!scene.witness.empty()) {
    ShorteningOptions shortest;
    shortest.random_cuts = 1000;
    shortest.pulls = 50;
    EXPECT_LT(result.length,
              1.15 * PathLength(ShortenPath(scene.witness, TriangleBvh(contact),
                                            shortest)))
        << family;
  }
  return result;
}

TEST(ContactSurfacePlanner, PassesWhateverIsWideEnough) {
  for (const double rotation : {0.0, 5.0}) {
    for (const double delta : {2e-2, 2e-3, 2e-4, 2e-5}) {
      for (const char* family :
           {"gap", "hole", "tunnel", "keyhole", "comb", "snake", "bugtrap"}) {
        const PlanResult result =
            PlanScene(family, {{"delta", delta}, {"rotation_seed", rotation}});
        EXPECT_EQ(result.status, PathStatus::kSolved) << family << delta;
        // Possible are δ/2.
        EXPECT_GT(result.clearance, 0.4 * 0.5 * delta) << family << delta;
        EXPECT_EQ(result.deleted_edges, 0) << family << delta;
      }
    }
  }
}

TEST(ContactSurfacePlanner, ProvesThatTwinsAreInfeasible) {
  for (const double rotation : {0.0, 5.0, 6.0}) {
    for (const char* family : {"gap", "hole", "tunnel", "keyhole", "comb",
                               "snake", "bugtrap", "clutter_hole", "maze"}) {
      const PlanResult result =
          PlanScene(family, {{"twin", 1.0}, {"rotation_seed", rotation}});
      EXPECT_EQ(result.status, PathStatus::kInfeasibleProved) << family;
      EXPECT_NE(result.start.cell, result.goal.cell) << family;
      EXPECT_EQ(result.self_intersections, 0) << family;
      EXPECT_FALSE(result.reason.empty());
    }
  }
}

TEST(ContactSurfacePlanner, SolvesClutterAndMazes) {
  for (const double rotation : {0.0, 5.0}) {
    const Knobs turned = {{"delta", 1e-4}, {"rotation_seed", rotation}};
    EXPECT_EQ(PlanScene("clutter_hole", turned).status, PathStatus::kSolved);
    Knobs maze = turned;
    maze["n"] = 4.0;
    EXPECT_EQ(PlanScene("maze", maze).status, PathStatus::kSolved);
  }
}

TEST(ContactSurfacePlanner, SolvesAtAllScalesAndOffsets) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const double offset : {1e3, 1e5}) {
      const PlanResult result = PlanScene("tunnel", {{"delta", 1e-4},
                                                     {"scale", scale},
                                                     {"offset", offset * scale},
                                                     {"rotation_seed", 2.0}});
      EXPECT_EQ(result.status, PathStatus::kSolved) << scale << " " << offset;
      EXPECT_GT(result.clearance, 0.4 * 0.5e-4 * scale);
    }
  }
}

// Coplanar facets as the arrangement left them, turned: needles everywhere.
TEST(ContactSurfacePlanner, CopesWithNeedles) {
  ContactSpaceOptions as_arranged;
  as_arranged.merge_coplanar = false;
  for (const char* family : {"keyhole", "snake", "clutter_hole"}) {
    for (const double twin : {0.0, 1.0}) {
      const Scene scene = ParseScene(
          MakeScene(family,
                    {{"delta", 1e-3}, {"twin", twin}, {"rotation_seed", 4.0}}),
          family);
      const ContactSpace contact = BuildContactSpace(
          scene.workspace.robot, MergedObstacle(scene.workspace), as_arranged);
      const PlanResult plan =
          ContactSurfacePlanner(contact).Plan(scene.start, scene.goal);
      EXPECT_LT(contact.report().worst_quality, 1e-2);
      EXPECT_EQ(plan.status, twin == 0.0 ? PathStatus::kSolved
                                         : PathStatus::kInfeasibleProved)
          << family << ": " << plan.reason;
    }
  }
}

TEST(ContactSurfacePlanner, ProvesThatNothingLeavesAVessel) {
  const ContactSurfacePlanner planner(TakeAsContactSpace(VesselSpace()));
  PlanResult result = planner.Plan({0.5, 0.1, 0.2}, {8.0, 0.0, 0.0});
  EXPECT_EQ(result.status, PathStatus::kInfeasibleProved);
  EXPECT_GE(result.start.cell, 0);
  EXPECT_EQ(result.goal.cell, FreeCells::kOutside);
  EXPECT_EQ(result.start.rays.back().end, CellRay::End::kShell);
  // And that all else can be reached: within it, and around it.
  result = planner.Plan({1.9, 1.9, -1.9}, {-1.9, 1.9, 1.9});
  EXPECT_EQ(result.status, PathStatus::kSolved);
  result = planner.Plan({-8.0, 0.1, 0.2}, {8.0, 0.0, 0.0});
  EXPECT_EQ(result.status, PathStatus::kSolved);
  EXPECT_GT(result.length, 2.0 * std::sqrt(4.0 + 36.0) + 12.0);
  EXPECT_LT(result.length, 1.1 * (2.0 * std::sqrt(4.0 + 36.0) + 12.0));
}

TEST(ContactSurfacePlanner, JoinsIslandsSideBySideThroughTheOutside) {
  // No ray leads from one to the other; start and goal touch either.
  const TriangleMesh mesh =
      Joined(MakeBox({0, 0, 0}, {1, 1, 1}), MakeBox({9, -7, 0}, {10, -6, 1}));
  const ContactSurfacePlanner planner(TakeAsContactSpace(mesh));
  const PlanResult result =
      planner.Plan({-0.001, 0.5, 0.5}, {10.001, -6.5, 0.5});
  EXPECT_EQ(result.status, PathStatus::kSolved);
  EXPECT_EQ(result.start.cell, FreeCells::kOutside);
}

TEST(ContactSurfacePlanner, RefusesStartsAndGoalsThatAreNotFree) {
  const ContactSurfacePlanner planner(TakeAsContactSpace(VesselSpace()));
  const Vector3d free = Vector3d::Zero();
  PlanResult result = planner.Plan({2.5, 0.0, 0.0}, free);
  EXPECT_EQ(result.status, PathStatus::kStartInCollision);
  EXPECT_EQ(result.reason, "start is 0.5 deep in an obstacle");
  result = planner.Plan(free, {0.0, 2.0, 0.0});
  EXPECT_EQ(result.status, PathStatus::kGoalInCollision);
  EXPECT_EQ(result.reason, "goal touches an obstacle");
  result = planner.Plan(free, {0.0, std::nan(""), 0.0});
  EXPECT_EQ(result.status, PathStatus::kGoalInCollision);
  EXPECT_EQ(result.reason, "goal is not finite");
  EXPECT_TRUE(result.path.empty());
}

TEST(ContactSurfacePlanner, NamesWhatIsInTheWay) {
  Workspace workspace;
  workspace.robot = MakeSolid(
      MakeBox(Vector3d::Constant(-0.5), Vector3d::Constant(0.5)), "robot");
  workspace.obstacles = {MakeSolid(MakeBox({1, -9, -9}, {2, 9, 9}), "wall"),
                         MakeSolid(MakeBox({-4, 0, -9}, {-3, 1, 9}), "post")};
  workspace.bounds = {Vector3d::Constant(-5.0), Vector3d::Constant(5.0)};
  const ContactSpace contact =
      BuildContactSpace(workspace.robot, MergedObstacle(workspace));
  EXPECT_EQ(contact.report().components, 3);
  const ContactSurfacePlanner planner(contact, {}, [&](const Vector3d& q) {
    return NameObstacles(workspace, q);
  });
  PlanResult plan = planner.Plan({1.0, 3, 0}, {-1, 0, 0});
  EXPECT_EQ(plan.status, PathStatus::kStartInCollision);
  EXPECT_EQ(plan.reason, "start is 0.5 deep in 'wall'");
  plan = planner.Plan({0, 0, 0}, {0, 0, 6.0});
  EXPECT_EQ(plan.reason, "goal is 1 deep in 'bounds'");
  plan = planner.Plan({0, 0, 0}, {4, 0, 0});
  EXPECT_EQ(plan.status, PathStatus::kInfeasibleProved);
  plan = planner.Plan({0, 0.5, 0}, {-4.75, 0.5, 0});
  EXPECT_EQ(plan.status, PathStatus::kSolved);
}

TEST(ContactSurfacePlanner, SolvesTrivialProblemsTrivially) {
  const ContactSurfacePlanner planner(TakeAsContactSpace(VesselSpace()));
  const Vector3d q(0.5, 0.25, 0.125);
  PlanResult result = planner.Plan(q, q);
  EXPECT_EQ(result.status, PathStatus::kSolved);
  EXPECT_EQ(result.path, std::vector<Vector3d>{q});
  EXPECT_EQ(result.length, 0.0);
  EXPECT_DOUBLE_EQ(result.clearance, 1.5);
  result = planner.Plan(q, -q);
  EXPECT_EQ(result.path, (std::vector<Vector3d>{q, -q}));
}

// Over the top of a cube, straight along it so close that rounding may have
// opened the way, or in an arc twice as long; whichever is offered first.
TEST(ContactSurfacePlanner, PrefersWaysThatRoundingDidNotOpen) {
  const PlanningSurface surface(
      TakeAsContactSpace(MakeBox({-1, -1, -1}, {1, 1, 1})), {}, {});
  for (const double share : {1e-3, 0.5, 2.0, 1e3}) {
    const double height = 1.0 + share * surface.cells.rounding();
    const std::vector<Vector3d> close = {
        {-2, 0, 1.5}, {-1, 0, height}, {1, 0, height}, {2, 0, 1.5}};
    const std::vector<Vector3d> arc = {{-2, 0, 1.5}, {0, 0, 5}, {2, 0, 1.5}};
    ASSERT_GT(PathLength(arc), 1.5 * PathLength(close));
    const bool is_certain = share > 1.0;
    for (const bool is_close_first : {true, false}) {
      PlanResult result;
      surface.Offer({}, is_close_first ? close : arc, &result);
      surface.Offer({}, is_close_first ? arc : close, &result);
      ASSERT_EQ(result.status, PathStatus::kSolved);
      EXPECT_EQ(result.path, is_certain ? close : arc) << share;
      EXPECT_TRUE(surface.IsCertain(result.clearance)) << share;
    }
  }
}

TEST(ContactSurfacePlanner, RepeatsItselfToTheBit) {
  const Knobs knobs = {{"delta", 1e-3}, {"rotation_seed", 3.0}};
  const PlanResult a = PlanScene("clutter_hole", knobs);
  const PlanResult b = PlanScene("clutter_hole", knobs);
  EXPECT_EQ(a.path, b.path);
  EXPECT_EQ(a.raw_path, b.raw_path);
}

TEST(ContactSurfacePlanner, RefusesOptionsOutOfRange) {
  ContactSurfaceOptions options;
  options.routes = 0;
  EXPECT_THROW(
      ContactSurfacePlanner(TakeAsContactSpace(VesselSpace()), options),
      InputError);
  options = {};
  options.spacing = 2.0;
  EXPECT_THROW(
      ContactSurfacePlanner(TakeAsContactSpace(VesselSpace()), options),
      InputError);
}

TEST(ContactSurfacePlanner, RefusesRequestsOutOfRange) {
  const ContactSurfacePlanner planner(TakeAsContactSpace(VesselSpace()));
  const Vector3d q = Vector3d::Constant(20.0);
  for (const double clearance :
       {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    RouteRequest request;
    request.clearance = clearance;
    EXPECT_THROW(planner.Plan(q, -q, request), InputError) << clearance;
  }
  RouteRequest request;
  request.routes = -1;
  EXPECT_THROW(planner.Plan(q, -q, request), InputError);
}

TEST(ContactSurfacePlanner, PlansTheSameFromSeveralThreads) {
  const ContactSurfacePlanner planner(TakeAsContactSpace(VesselSpace()));
  const Vector3d start = Vector3d::Constant(20.0), goal = -start;
  const PlanResult expected = planner.Plan(start, goal);
  const PlanResult proof = planner.Plan(start, Vector3d::Zero());
  std::vector<PlanResult> found(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i) {
    threads.emplace_back([&, i] {
      found[i] = planner.Plan(start, i % 2 == 0 ? goal : Vector3d::Zero());
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const PlanResult& same = i % 2 == 0 ? expected : proof;
    EXPECT_EQ(found[i].status, same.status);
    EXPECT_EQ(found[i].path, same.path);
    EXPECT_EQ(found[i].self_intersections, same.self_intersections);
  }
}

}  // namespace
}  // namespace phongpd
