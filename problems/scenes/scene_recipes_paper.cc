// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's three benchmarks as scenes.

#include "problems/scenes/scene_recipes.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using Values = KnobValues;
using Layout = SceneLayout;

Json UvBall(Values& v) {
  return {{"type", "uv_ball"},
          {"radius", v["ball_radius"]},
          {"meridians", CountJson(v["meridians"])},
          {"parallels", CountJson(v["parallels"])}};
}

Json Cone(Values& v) {
  return {{"type", "cone"},
          {"radius", v["cone_radius"]},
          {"height", v["cone_height"]},
          {"sides", CountJson(v["sides"])}};
}

Layout BallCone(Values& v) {
  const double x = 1.5 * (v["ball_radius"] + v["cone_radius"]);
  const double z = 0.3 * v["cone_height"];
  return OneObstacle(UvBall(v), Cone(v), {0, 0, 0},
                     2.0 * (x + v["cone_height"]), {-x, 0.1 * x, z},
                     {x, 0.1 * x, z});
}

Layout ConeAxes(Values& v) {
  const double x = 1.2 * (v["half_length"] + v["cone_radius"]);
  const Json axes = {{"type", "axes"},
                     {"half_length", v["half_length"]},
                     {"half_width", v["half_width"]}};
  return OneObstacle(Cone(v), axes, {0, 0, 0}, 2.0 * (x + v["cone_height"]),
                     {-x, -x, -0.2 * x}, {x, x, 0.2 * x});
}

Layout BallWrench(Values& v) {
  const double y = 1.5 * (1.2 * v["wrench"] + v["ball_radius"]);
  const double x = 0.3 * v["wrench"];
  const Json wrench = {{"type", "wrench"}, {"scale", v["wrench"]}};
  return OneObstacle(UvBall(v), wrench, {0, 0, 0}, 5.0 * v["wrench"] + 2.0 * y,
                     {x, -y, 0.0}, {x, y, 0.0});
}

}  // namespace

std::vector<SceneRecipe> PaperRecipes() {
  const SceneKnob meridians = {"meridians", 24, "of the robot ball"};
  const SceneKnob parallels = {"parallels", 22, "of the robot ball"};
  const SceneKnob cone_radius = {"cone_radius", 0.8, "base radius"};
  const SceneKnob cone_height = {"cone_height", 1.6, "base to apex"};
  const SceneKnob sides = {"sides", 40, "of the cone: 2·sides − 2 triangles"};
  return {
      {{"ball_cone",
        "the paper's first benchmark: a ball and a cone",
        {{"ball_radius", 1.0, "radius of the robot ball"},
         meridians,
         parallels,
         cone_radius,
         cone_height,
         sides}},
       BallCone},
      {{"cone_axes",
        "the paper's second: a cone and three crossing bars",
        {cone_radius,
         cone_height,
         sides,
         {"half_length", 2.0, "of each bar"},
         {"half_width", 0.2, "of each bar"}}},
       ConeAxes},
      {{"ball_wrench",
        "the paper's third: a ball and a wrench",
        {{"ball_radius", 0.4, "radius of the robot ball"},
         meridians,
         parallels,
         {"wrench", 1.0, "scale of the wrench, 7 × 2.4 × 0.5 at 1"}}},
       BallWrench},
  };
}

}  // namespace phongpd
