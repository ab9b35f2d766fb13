// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/fleet_scene.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "problems/output/fleet_row.h"
#include "problems/scenes/json_schema.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

// Two equal cubes and a larger one, a pillar, and a tray that comes by.
const char kThree[] = R"({
  "name": "three",
  "robots": [
    {"id": "a", "shape": {"type": "box", "size": [1, 1, 1]},
     "start": [-4, 0, 0], "goal": [4, 0, 0],
     "via": [{"point": [0, 3, 0], "dwell": 0.5}]},
    {"shape": {"type": "box", "size": [1, 1, 1]},
     "start": [4, 0, 0], "goal": [-4, 0, 0],
     "limits": {"velocity": 3, "acceleration": 4, "jerk": 50}},
    {"id": "big", "shape": {"type": "box", "size": [1, 1, 1]}, "scale": 2,
     "start": [0, -3, 0], "goal": [0, -3, 0],
     "bounds": {"min": [-8, -8, -1], "max": [8, 8, 2]}}],
  "obstacles": [{"id": "pillar", "shape": {"type": "box", "size": [1, 1, 9]}}],
  "moving": [{"id": "tray", "shape": {"type": "box", "size": [1, 1, 1]},
              "position": [0, 0, 7],
              "motion": [{"duration": 2, "points": [[0, 0, 0], [1, 0, 0]]}]}],
  "bounds": {"min": [-9, -9, -1], "max": [9, 9, 1]},
  "limits": {"velocity": 1, "acceleration": 2, "jerk": 10},
  "preset": "fast"
})";

Json Good() { return ParseJson(kThree, "s.json"); }

std::string Message(const Json& json) {
  return testing::ErrorOf([&] { ParseFleetScene(json, "s.json"); });
}

std::string MessageWith(const std::string& pointer, const Json& value) {
  Json json = Good();
  json[Pointer(pointer)] = value;
  return Message(json);
}

TEST(FleetScene, GivesEachRobotItsTaskAndTheCommonRoom) {
  const FleetScene fleet = ParseFleetScene(Good(), "s.json");
  EXPECT_EQ(fleet.name, "three");
  ASSERT_EQ(fleet.robots.size(), 3u);
  const Scene& a = fleet.robots[0];
  const Scene& second = fleet.robots[1];
  const Scene& big = fleet.robots[2];
  EXPECT_EQ(a.workspace.robot.name(), "a");
  EXPECT_EQ(second.workspace.robot.name(), "robot1");
  EXPECT_EQ(ComputeBounds(big.workspace.robot).max, Vector3d(1, 1, 1));
  EXPECT_EQ(a.start, Vector3d(-4, 0, 0));
  ASSERT_EQ(a.via.size(), 1u);
  EXPECT_EQ(a.via[0].dwell, 0.5);
  EXPECT_TRUE(second.via.empty());
  EXPECT_EQ(a.limits->velocity, Vector3d(1, 1, 1));
  EXPECT_EQ(second.limits->velocity, Vector3d(3, 3, 3));
  EXPECT_EQ(a.workspace.bounds.max.z(), 1.0);
  EXPECT_EQ(big.workspace.bounds.max.z(), 2.0);
  for (const Scene& scene : fleet.robots) {
    EXPECT_EQ(scene.preset, Preset::kFast);
    ASSERT_EQ(scene.workspace.obstacles.size(), 1u);
    ASSERT_EQ(scene.moving.size(), 1u);
    EXPECT_EQ(scene.moving[0].solid.name(), "tray");
  }
}

TEST(FleetScene, BuildsOnceForEqualRobotsInEqualBounds) {
  const FleetScene fleet = ParseFleetScene(Good(), "s.json");
  const std::vector<FleetRobot> robots = RobotsOf(fleet, {}, {});
  ASSERT_EQ(robots.size(), 3u);
  robots[0].world.Convolution();
  EXPECT_NE(robots[1].world.BuiltConvolution(), nullptr);
  EXPECT_EQ(robots[2].world.BuiltConvolution(), nullptr);
  EXPECT_EQ(robots[1].name, "robot1");
  EXPECT_EQ(robots[1].request.goal, Vector3d(-4, 0, 0));
  EXPECT_EQ(robots[2].request.moving.size(), 1u);
}

TEST(FleetScene, IsNoSceneOfOneRobot) {
  const std::string what =
      testing::ErrorOf([&] { ParseScene(Good(), "s.json"); });
  EXPECT_EQ(what,
            "s.json: /robots: expected one robot here, as \"robot\", "
            "found a list of 3; motions of several are found by phongpd "
            "optimize");
  Json one = Good();
  one["robot"] = one["robots"][0];
  EXPECT_EQ(Message(one),
            "s.json: expected either \"robot\" or \"robots\", found \"robot\" "
            "and \"robots\"");
  one.erase("robots");
  one["robot"] = {{"shape", {{"type", "box"}, {"size", {1, 1, 1}}}}};
  EXPECT_EQ(Message(one),
            "s.json: /start: expected an array of 3 numbers, found nothing");
  one.erase("robot");
  EXPECT_EQ(Message(one),
            "s.json: expected either \"robot\" or \"robots\", found neither");
}

TEST(FleetScene, SaysWhatIsWrongWithARobot) {
  EXPECT_EQ(MessageWith("/robots/1/id", "a"),
            "s.json: /robots/1/id: expected an id of its own, found \"a\" a "
            "second time");
  EXPECT_EQ(MessageWith("/robots/1/id", "pillar"),
            "s.json: /robots/1/id: expected an id of its own, found "
            "\"pillar\" a second time");
  EXPECT_EQ(MessageWith("/robots/0/id", "../a"),
            "s.json: /robots/0/id: expected letters, digits, - and _, as files "
            "are named by it, found \"../a\"");
  EXPECT_EQ(MessageWith("/goal", {1, 2, 3}),
            "s.json: /goal: expected none beside \"robots\", each of which has "
            "its own, found [1,2,3]");
  EXPECT_EQ(MessageWith("/robots/0/via/0/tolerance", "7D"),
            "s.json: /robots/0/via/0/tolerance: expected at most 1 (the "
            "world's diagonal D), found 7");
  EXPECT_NE(MessageWith("/robots/0/departure", Json::object())
                .find("/robots/0: expected only the keys"),
            std::string::npos);
  EXPECT_NE(MessageWith("/robots/2/bounds/max/2", -1).find("/robots/2/bounds"),
            std::string::npos);
  EXPECT_NE(MessageWith("/robots", Json::array()).find("/robots"),
            std::string::npos);
  Json json = Good();
  json["robots"][1].erase("goal");
  EXPECT_EQ(
      Message(json),
      "s.json: /robots/1/goal: expected an array of 3 numbers, found nothing");
  json["robots"][1] = 5;
  EXPECT_NE(Message(json).find("/robots/1: expected an object"),
            std::string::npos);
}

}  // namespace
}  // namespace phongpd
