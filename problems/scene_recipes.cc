// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scene_recipes.h"

#include <algorithm>

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::map<std::string, double>;
using Layout = SceneLayout;

// Counts are written as whole numbers; anything else stays as it is for
// MakeShape to refuse.
Json Count(double value) {
  const auto whole = static_cast<long long>(std::clamp(value, -1e9, 1e9));
  return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

Json Ball(double radius, double triangles) {
  return {
      {"type", "ball"}, {"radius", radius}, {"triangles", Count(triangles)}};
}

Json UvBall(Values& v) {
  return {{"type", "uv_ball"},
          {"radius", v["ball_radius"]},
          {"meridians", Count(v["meridians"])},
          {"parallels", Count(v["parallels"])}};
}

Json Cone(Values& v) {
  return {{"type", "cone"},
          {"radius", v["cone_radius"]},
          {"height", v["cone_height"]},
          {"sides", Count(v["sides"])}};
}

Layout BallCone(Values& v) {
  const double x = 1.5 * (v["ball_radius"] + v["cone_radius"]);
  const double z = 0.3 * v["cone_height"];
  return {UvBall(v),        Cone(v),
          {0, 0, 0},        2.0 * (x + v["cone_height"]),
          {-x, 0.1 * x, z}, {x, 0.1 * x, z}};
}

Layout ConeAxes(Values& v) {
  const double x = 1.2 * (v["half_length"] + v["cone_radius"]);
  const Json axes = {{"type", "axes"},
                     {"half_length", v["half_length"]},
                     {"half_width", v["half_width"]}};
  return {Cone(v),
          axes,
          {0, 0, 0},
          2.0 * (x + v["cone_height"]),
          {-x, -x, -0.2 * x},
          {x, x, 0.2 * x}};
}

Layout BallWrench(Values& v) {
  const double y = 1.5 * (1.2 * v["scale"] + v["ball_radius"]);
  const double x = 0.3 * v["scale"];
  const Json wrench = {{"type", "wrench"}, {"scale", v["scale"]}};
  return {UvBall(v),    wrench,     {0, 0, 0}, 5.0 * v["scale"] + 2.0 * y,
          {x, -y, 0.0}, {x, y, 0.0}};
}

Layout UTrap(Values& v) {
  const double size = v["size"];
  const Json u = {{"type", "u"},
                  {"size", size},
                  {"wall", v["wall"]},
                  {"height", v["height"]}};
  const double x = 0.5 * size + 5.0 * v["ball_radius"];
  return {Ball(v["ball_radius"], v["triangles"]),
          u,
          {-0.5 * size, -0.5 * size, -0.5 * v["height"]},
          2.0 * x,
          {-x, 0.0, 0.0},
          {x, 0.0, 0.0}};
}

Layout LShape(Values& v) {
  const double size = v["size"];
  const Json l = {{"type", "l"},
                  {"size", size},
                  {"width", v["width"]},
                  {"height", v["height"]}};
  const double x = 0.5 * size + 5.0 * v["ball_radius"];
  return {Ball(v["ball_radius"], v["triangles"]),
          l,
          {-0.5 * size, -0.5 * size, -0.5 * v["height"]},
          2.0 * x,
          {-x, -x, 0.0},
          {x, x, 0.0}};
}

Layout PlateHole(Values& v) {
  const double cube = v["hole"] - v["clearance"];
  const Json plate = {{"type", "plate_hole"},
                      {"side", v["side"]},
                      {"thickness", v["thickness"]},
                      {"hole", v["hole"]}};
  const double z = v["thickness"] + cube;
  const double x = 0.3 * v["side"];
  return {{{"type", "box"}, {"size", {cube, cube, cube}}},
          plate,
          {0, 0, 0},
          v["side"] + 2.0 * z,
          {x, 0.1 * x, z},
          {-x, -0.2 * x, -z}};
}

Layout TorusHole(Values& v) {
  const Json torus = {{"type", "torus"},
                      {"major_radius", v["major_radius"]},
                      {"minor_radius", v["minor_radius"]},
                      {"around", Count(v["around"])},
                      {"across", Count(v["across"])}};
  const double z = 2.0 * (v["minor_radius"] + v["ball_radius"]);
  const double x = v["major_radius"];
  return {Ball(v["ball_radius"], v["triangles"]),
          torus,
          {0, 0, 0},
          2.0 * (v["major_radius"] + z),
          {x, 0.1 * x, -z},
          {-x, -0.1 * x, z}};
}

Layout ThinWall(Values& v) {
  const Json wall = {{"type", "box"},
                     {"size", {v["thickness"], v["side"], v["side"]}}};
  const double x = 0.5 * v["side"];
  return {Ball(v["ball_radius"], v["triangles"]),
          wall,
          {0, 0, 0},
          2.0 * v["side"],
          {-x, 0.1 * x, 0.05 * x},
          {x, 0.0, -0.05 * x}};
}

Layout CubeVessel(Values& v) {
  const double cube = v["cube"];
  const Json vessel = {{"type", "vessel"},
                       {"outer", v["outer"]},
                       {"inner", v["inner"]},
                       {"window", v["window"]}};
  const double z = 0.5 * v["outer"] + 2.0 * cube;
  return {{{"type", "box"}, {"size", {cube, cube, cube}}},
          vessel,
          {0, 0, 0},
          2.0 * z,
          {0.1 * cube, 0.0, 0.0},
          {0.5 * v["outer"], 0.0, z}};
}

}  // namespace

const std::vector<SceneRecipe>& SceneRecipes() {
  const SceneKnob ball = {"ball_radius", 0.1, "radius of the robot ball"};
  const SceneKnob faces = {"triangles", 320, "of the robot ball: 20·4^k"};
  const SceneKnob meridians = {"meridians", 24, "of the robot ball"};
  const SceneKnob parallels = {"parallels", 22, "of the robot ball"};
  const SceneKnob cone_radius = {"cone_radius", 0.8, "base radius"};
  const SceneKnob cone_height = {"cone_height", 1.6, "base to apex"};
  const SceneKnob sides = {"sides", 40, "of the cone: 2·sides − 2 triangles"};
  static const std::vector<SceneRecipe> recipes = {
      {{"ball_cone",
        "the paper's first benchmark: a ball and a cone",
        {{"ball_radius", 1.0, ball.meaning},
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
        {{"ball_radius", 0.4, ball.meaning},
         meridians,
         parallels,
         {"scale", 1.0, "of the wrench, 6 × 2.4 × 0.5 at 1"}}},
       BallWrench},
      {{"u_trap",
        "a ball behind the closed side of a U",
        {ball,
         faces,
         {"size", 2.0, "outer width of the U"},
         {"wall", 0.2, "thickness of its walls"},
         {"height", 1.0, "of the U"}}},
       UTrap},
      {{"l",
        "a ball on the outer side of an L",
        {ball,
         faces,
         {"size", 2.0, "length of both legs"},
         {"width", 0.4, "of the legs"},
         {"height", 1.0, "of the L"}}},
       LShape},
      {{"plate_hole",
        "a cube that fits through the square hole of a plate",
        {{"side", 2.0, "of the plate"},
         {"thickness", 0.2, "of the plate"},
         {"hole", 0.4, "side of the hole"},
         {"clearance", 0.04, "hole less cube; negative: it does not fit"}}},
       PlateHole},
      {{"torus_hole",
        "a ball that fits through a torus",
        {{"ball_radius", 0.3, ball.meaning},
         faces,
         {"major_radius", 1.0, "centre of the tube"},
         {"minor_radius", 0.3, "of the tube"},
         {"around", 48, "corners along the tube"},
         {"across", 24, "corners across the tube"}}},
       TorusHole},
      {{"thin_wall",
        "a ball before a thin wall",
        {ball,
         faces,
         {"side", 2.0, "of the wall"},
         {"thickness", 0.01, "of the wall"}}},
       ThinWall},
      {{"cube_vessel",
        "a cube in a hollow box with a window",
        {{"cube", 0.5, "side of the robot cube"},
         {"outer", 3.0, "side of the box"},
         {"inner", 2.0, "side of its cavity"},
         {"window", 0.8, "side of the opening; 0: none"}}},
       CubeVessel},
  };
  return recipes;
}

}  // namespace phongpd
