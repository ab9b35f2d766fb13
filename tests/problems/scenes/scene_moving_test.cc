// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/mesh/mesh_error.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/scene_requests.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

// A cube goes along x; a gate stands beside, and a cart crosses in front of it.
const char kCrossing[] = R"({
  "robot": {"shape": {"type": "box", "size": [1, 1, 1]}},
  "obstacles": [{"id": "gate", "shape": {"type": "box", "size": [2, 1, 2]},
                 "position": [0, 2.5, 0]}],
  "bounds": {"min": [-9, -1, -1], "max": [9, 1, 1]},
  "start": [-8, 0, 0], "goal": [8, 0, 0], "preset": "fast",
  "limits": {"velocity": 1, "acceleration": 2, "jerk": 10},
  "moving": [
    {"id": "cart", "shape": {"type": "box", "size": [2, 4, 2]},
     "position": [0, 0, 4],
     "motion": [{"duration": 5, "points": [[0, 0, 0], [0, 0, 0]]},
                {"duration": 9, "points": [[0, 0, 0], [0, 0, 0], [0, 0, -9],
                                           [0, 0, -9]]}]}]
})";

Scene SceneOf(const Json& json) { return ParseScene(json, "s.json"); }

TEST(SceneMoving, IsReadAndKeptOff) {
  const Scene scene = SceneOf(ParseJson(kCrossing, "s.json"));
  ASSERT_EQ(scene.moving.size(), 1u);
  const MovingObstacle& cart = scene.moving[0];
  EXPECT_EQ(cart.solid.name(), "cart");
  EXPECT_EQ(ComputeBounds(cart.solid).min, Vector3d(-1, -2, 3));
  EXPECT_EQ(cart.motion.duration(), 14.0);
  EXPECT_EQ(cart.motion.pieces()[1].degree(), 3);
  EXPECT_EQ(cart.motion.At(14.0).position, Vector3d(0, 0, -9));
  const World world(scene.workspace);
  const PathAnswer answer = Optimize(world, OptimizeRequestOf(scene));
  EXPECT_TRUE(answer.is_solved) << answer.reason;
  // The cart is in the way until 5 + 9 s with 3s² − 2s³ = 5.5/9, and from
  // x = −1.5 on it takes 9.5 s at full speed and 0.35 s more to come to rest.
  const double gone = 5.0 + 9.0 * 0.5747;
  EXPECT_GE(answer.motion.duration(), gone + 9.85);
  EXPECT_LE(answer.motion.duration(), 1.02 * (gone + 9.85));
}

TEST(SceneMoving, IsRefusedWhereThereIsNoTime) {
  Json json = ParseJson(kCrossing, "s.json");
  EXPECT_THROW(PlanRequestOf(SceneOf(json)), InputError);
  json.erase("limits");
  const Scene scene = SceneOf(json);
  EXPECT_THROW(Optimize(World(scene.workspace), OptimizeRequestOf(scene)),
               InputError);
}

TEST(SceneMoving, SaysWhatIsWrongWithIt) {
  const auto message = [](const std::string& pointer,
                          const Json& value) -> std::string {
    Json json = ParseJson(kCrossing, "s.json");
    json[Pointer(pointer)] = value;
    return testing::ErrorOf([&] { SceneOf(json); });
  };
  EXPECT_EQ(message("/moving/0/id", "gate"),
            "s.json: /moving/0/id: expected an id of its own, found \"gate\" a "
            "second time");
  EXPECT_EQ(message("/moving/0/motion/1/points/0", {0, 0, 1}),
            "s.json: /moving/0/motion/1/points/0: expected the last point of "
            "the piece before it, found [0,0,1]");
  EXPECT_EQ(message("/moving/0/motion/0/duration", 0),
            "s.json: /moving/0/motion/0/duration: expected a number > 0 and <= "
            "1e+09, found 0");
  EXPECT_NE(message("/moving/0/motion", Json::array()).find("/moving/0/motion"),
            std::string::npos);
  EXPECT_NE(message("/moving/0/speed", 1).find("only the keys"),
            std::string::npos);
}

}  // namespace
}  // namespace phongpd
