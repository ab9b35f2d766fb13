// SPDX-License-Identifier: GPL-3.0-or-later
// A start or goal that is not free is said before a contact space is built.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/solid/solid.h"
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "problems/output/answer_row.h"
#include "problems/scenes/kept_world.h"
#include "problems/scenes/scene_requests.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

// Five tori of some thousand triangles; tests count contact spaces, not time.
Json Tori() {
  Json json = Json::parse(R"({"name": "tori",
    "robot": {"shape": {"type": "ball", "radius": 0.2, "triangles": 320}},
    "obstacles": [],
    "bounds": {"min": [-3, -3, -1], "max": [12, 3, 1]},
    "start": [-2, 0, 0], "goal": [10.5, 0, 0]})");
  for (int i = 0; i < 5; ++i) {
    json["obstacles"].push_back({{"id", "torus" + std::to_string(i)},
                                 {"shape",
                                  {{"type", "torus"},
                                   {"major_radius", 1.0},
                                   {"minor_radius", 0.4},
                                   {"around", 64},
                                   {"across", 40}}},
                                 {"position", {2.5 * i, 0.0, 0.0}}});
  }
  return json;
}

struct Case {
  const char* end;
  Json place;
  std::string status;
  std::string begins;  // of the reason
};

std::vector<Case> Cases() {
  return {{"start",
           {3.5, 0, 0},
           "start_in_collision",
           "start (3.5,0,0) is at most 0."},
          {"goal",
           {7.5, 1, 0},
           "goal_in_collision",
           "goal (7.5,1,0) is at most 0."},
          {"goal",
           {13, 0, 0},
           "goal_out_of_bounds",
           "goal (13,0,0) is not strictly within the bounds: x is 1 above the "
           "maximum 12"},
          {"start",
           {-4, 0, 0},
           "start_out_of_bounds",
           "start (-4,0,0) is not strictly within the bounds: x is 1 below "}};
}

TEST(EarlyDiagnosis, PlansBuildNothingForBlockedEnds) {
  for (const Case& c : Cases()) {
    Json json = Tori();
    json[c.end] = c.place;
    const Scene scene = ParseScene(json, "tori.json");
    const World world(scene.workspace, scene.name);
    PlanRequest request = PlanRequestOf(scene);
    for (const PlannerId planner :
         {PlannerId::kContactSurface, PlannerId::kRetractionForest,
          PlannerId::kRrtConnect}) {
      request.planner = planner;
      const PathAnswer answer = Plan(world, request);
      EXPECT_FALSE(answer.is_solved);
      EXPECT_TRUE(answer.path.empty());
      EXPECT_EQ(answer.reason.find(c.begins), 0U) << answer.reason;
      EXPECT_EQ(ToString(answer.status), c.status);
      const Json row = PlanRow(scene, world, request, answer);
      EXPECT_EQ(row["contact_triangles"], 0);
      EXPECT_EQ(row["seconds"]["contact_space"], 0.0);
    }
    EXPECT_EQ(world.Report().contact_spaces, 0);
    // Bad options are still bad input.
    request.planner = PlannerId::kPrm;
    request.time_limit = -1.0;
    EXPECT_THROW(Plan(world, request), InputError);
    EXPECT_THROW(ParsePlanner("fast", "--planner"), InputError);
  }
}

// The planner, a sampler of OMPL and the optimiser on one scene.
TEST(World, IsSharedByAllThatPlanInIt) {
  for (const bool has_bounds : {false, true}) {
    Json json = Json::parse(R"({"name": "shared",
      "robot": {"shape": {"type": "box", "size": [0.2, 0.2, 0.2]}},
      "obstacles": [{"shape": {"type": "box", "size": [0.2, 1, 1]}}],
      "start": [-1, 0, 0.1], "goal": [1, 0.1, 0],
      "trajectory": {"waypoints": 12}})");
    if (has_bounds)
      json["bounds"] = {{"min", {-2, -2, -2}}, {"max", {2, 2, 2}}};
    const Scene scene = ParseScene(json, "shared.json");
    const World world(scene.workspace, scene.name);
    PlanRequest request = PlanRequestOf(scene);
    request.time_limit = 20.0;
    for (const PlannerId planner :
         {PlannerId::kContactSurface, PlannerId::kRetractionForest}) {
      request.planner = planner;
      EXPECT_TRUE(Plan(world, request).is_solved) << ToString(planner);
    }
    EXPECT_EQ(world.Report().contact_spaces, 1);
    EXPECT_TRUE(Optimize(world, OptimizeRequestOf(scene)).is_free);
    // Bounds belong to the planners' space and not to the optimiser's.
    EXPECT_EQ(world.Report().contact_spaces, has_bounds ? 2 : 1);
    // Other solids are another world.
    Scene other = scene;
    TriangleMesh moved = other.workspace.obstacles[0];
    moved.vertices[0].x() -= 1.0;
    other.workspace.obstacles[0] =
        MakeSolid(moved, other.workspace.obstacles[0].name());
    KeptWorld worlds;
    const double diagonal = worlds.Of(scene).diagonal();
    EXPECT_EQ(worlds.Of(scene).diagonal(), diagonal);
    EXPECT_NE(worlds.Of(other).diagonal(), diagonal);
  }
}

TEST(EarlyDiagnosis, TrajectoriesBuildNothingForBlockedEnds) {
  for (const bool is_per_obstacle : {false, true}) {
    for (const Case& c : Cases()) {
      Json json = Tori();
      json[c.end] = c.place;
      const Scene scene = ParseScene(json, "tori.json");
      const World world(scene.workspace, scene.name);
      OptimizeRequest request = OptimizeRequestOf(scene);
      request.is_per_obstacle = is_per_obstacle;
      const PathAnswer answer = Optimize(world, request);
      EXPECT_EQ(ToString(answer.status), c.status);
      EXPECT_EQ(answer.reason.find(c.begins), 0U) << answer.reason;
      const Json row = PolylineRow(scene, world, request, answer);
      EXPECT_EQ(row["contact_triangles"], 0);
      EXPECT_EQ(row["collision_free"], false);
      EXPECT_EQ(world.Report().contact_spaces, 0);
      request.options.optimizer.ipopt.ipopt_options["tool"] = "1";
      EXPECT_THROW(Optimize(world, request), InputError);
    }
  }
}

}  // namespace
}  // namespace phongpd
