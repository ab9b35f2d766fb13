// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes for trajectories: one obstacle, or a heap of boxes.

#include <utility>
#include <vector>

#include "problems/scenes/scene_recipes.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using Values = KnobValues;
using Layout = SceneLayout;

using Eigen::Vector3d;

Json Ball(double radius, double triangles) {
  return {{"type", "ball"},
          {"radius", radius},
          {"triangles", CountJson(triangles)}};
}

// The obstacle as designed, or finely tessellated with a hundredth of its edges
// as noise.
Json Scanned(const Json& shape, Values& v) {
  if (v["edge"] == 0.0) return shape;
  return {{"type", "scan"},
          {"of", shape},
          {"edge", v["edge"]},
          {"noise", 0.01 * v["edge"]},
          {"seed", 1}};
}

Layout UTrap(Values& v) {
  const double size = v["size"];
  const Json u = {{"type", "u"},
                  {"size", size},
                  {"wall", v["wall"]},
                  {"height", v["height"]}};
  const double x = 0.5 * size + 5.0 * v["ball_radius"];
  return OneObstacle(Ball(v["ball_radius"], v["triangles"]), Scanned(u, v),
                     {-0.5 * size, -0.5 * size, -0.5 * v["height"]}, 2.0 * x,
                     {-x, 0.0, 0.0}, {x, 0.0, 0.0});
}

Layout LShape(Values& v) {
  const double size = v["size"];
  const Json l = {{"type", "l"},
                  {"size", size},
                  {"width", v["width"]},
                  {"height", v["height"]}};
  const double x = 0.5 * size + 5.0 * v["ball_radius"];
  return OneObstacle(Ball(v["ball_radius"], v["triangles"]), l,
                     {-0.5 * size, -0.5 * size, -0.5 * v["height"]}, 2.0 * x,
                     {-x, -x, 0.0}, {x, x, 0.0});
}

Layout PlateHole(Values& v) {
  const double cube = v["hole"] - v["clearance"];
  const Json plate = {{"type", "plate_hole"},
                      {"side", v["side"]},
                      {"thickness", v["thickness"]},
                      {"hole", v["hole"]}};
  const double z = v["thickness"] + cube;
  const double x = 0.3 * v["side"];
  Layout layout = OneObstacle({{"type", "box"}, {"size", {cube, cube, cube}}},
                              plate, {0, 0, 0}, v["side"] + 2.0 * z,
                              {x, 0.1 * x, z}, {-x, -0.2 * x, -z});
  layout.freedom = 0.2 * (z - 0.5 * v["thickness"] - 0.5 * cube);
  return layout;
}

Layout TorusHole(Values& v) {
  const Json torus = {{"type", "torus"},
                      {"major_radius", v["major_radius"]},
                      {"minor_radius", v["minor_radius"]},
                      {"around", CountJson(v["around"])},
                      {"across", CountJson(v["across"])}};
  const double z = 2.0 * (v["minor_radius"] + v["ball_radius"]);
  const double x = v["major_radius"];
  return OneObstacle(Ball(v["ball_radius"], v["triangles"]), torus, {0, 0, 0},
                     2.0 * (v["major_radius"] + z), {x, 0.1 * x, -z},
                     {0.9 * x, -0.1 * x, z});
}

Layout ThinWall(Values& v) {
  const Json wall = {{"type", "box"},
                     {"size", {v["thickness"], v["side"], v["side"]}}};
  const double x = 0.5 * v["side"];
  return OneObstacle(Ball(v["ball_radius"], v["triangles"]), Scanned(wall, v),
                     {0, 0, 0}, 2.0 * v["side"], {-x, 0.1 * x, 0.05 * x},
                     {x, 0.0, -0.05 * x});
}

Layout CubeVessel(Values& v) {
  const double cube = v["cube"];
  const Json vessel = {{"type", "vessel"},
                       {"outer", v["outer"]},
                       {"inner", v["inner"]},
                       {"window", v["window"]}};
  const double z = 0.5 * v["outer"] + 2.0 * cube;
  Layout layout = OneObstacle(
      {{"type", "box"}, {"size", {cube, cube, cube}}}, vessel, {0, 0, 0},
      2.0 * z, {0.1 * cube, 0.0, 0.0}, {0.5 * v["outer"], 0.0, z});
  layout.route = SceneRoute::kPassage;
  layout.passage = {Vector3d::Zero(), {0.0, 0.0, z}};
  layout.is_feasible = v["window"] > cube;
  layout.freedom = 0.05 * cube;
  return layout;
}

Layout UAxis(Values& v) {
  Layout layout = UTrap(v);
  const double y = 0.5 * v["size"] + 5.0 * v["ball_radius"];
  layout.start = {0.0, -y, 0.0};
  layout.goal = {0.0, y, 0.0};
  layout.freedom = v["ball_radius"];
  return layout;
}

Layout BallConvex(Values& v) {
  const double x = 1.5 * (v["radius"] + v["ball_radius"]);
  const Json prism = {{"type", "prism"},
                      {"radius", v["radius"]},
                      {"height", v["height"]},
                      {"sides", CountJson(v["sides"])}};
  return OneObstacle(Ball(v["ball_radius"], v["triangles"]), prism, {0, 0, 0},
                     2.0 * (x + v["height"]), {-x, 0.1 * x, 0.1 * v["height"]},
                     {x, 0.0, -0.1 * v["height"]});
}

Layout LongPlate(Values& v) {
  const Json plate = {{"type", "box"},
                      {"size", {v["length"], v["width"], v["thickness"]}}};
  const double x = 0.5 * v["length"] + 5.0 * v["ball_radius"];
  Layout layout =
      OneObstacle(Ball(v["ball_radius"], v["triangles"]), Scanned(plate, v),
                  {0, 0, 0}, 2.0 * x, {-x, 0.0, 0.0}, {x, 0.0, 0.0});
  layout.freedom = v["ball_radius"];
  return layout;
}

Layout PegTunnel(Values& v) {
  const double cube = v["channel"] - v["clearance"];
  const Json block = {{"type", "plate_hole"},
                      {"side", v["side"]},
                      {"thickness", v["length"]},
                      {"hole", v["channel"]}};
  const double z = 0.5 * v["length"] + cube, x = 0.2 * v["side"];
  Layout layout =
      OneObstacle({{"type", "box"}, {"size", {cube, cube, cube}}}, block,
                  {0, 0, 0}, v["side"] + v["length"] + 2.0 * cube,
                  {x, 0.5 * x, z}, {-x, -0.5 * x, -z});
  if (v["clearance"] > 0.0) {
    layout.route = SceneRoute::kPassage;
    layout.passage = {{0.0, 0.0, z}, {0.0, 0.0, -z}};
  }
  layout.freedom = 0.2 * cube;
  return layout;
}

Layout Knot(Values& v) {
  const Json knot = {{"type", "knot"},
                     {"size", v["size"]},
                     {"tube", v["tube"]},
                     {"around", CountJson(v["around"])},
                     {"across", CountJson(v["across"])}};
  const double y = 3.0 * v["size"] + 2.0 * (v["tube"] + v["ball_radius"]);
  return OneObstacle(Ball(v["ball_radius"], v["triangles"]), knot, {0, 0, 0},
                     1.5 * y, {0.0, -y, 0.0}, {0.1 * v["size"], y, 0.0});
}

Layout Clutter(Values& v) {
  const double reach = v["reach"], r = v["ball_radius"];
  const double x = 1.5 * (reach + 2.0 * v["box"] + r);
  Layout layout;
  layout.robot = Ball(r, v["triangles"]);
  layout.obstacles =
      RandomBoxes(static_cast<int>(WholeKnob(v, "boxes", 1, 1000)),
                  0.25 * v["box"], v["box"], reach, 0.0, {},
                  static_cast<std::uint64_t>(WholeKnob(v, "layout", 0, 1e15)));
  // The first one is in the way.
  layout.obstacles[0].position.setZero();
  layout.bounds = {Vector3d::Constant(-x), Vector3d::Constant(x)};
  layout.start = {-x, 0.1 * reach, 0.0};
  layout.goal = {x, -0.1 * reach, 0.0};
  return layout;
}

SceneKnob BallKnob(double radius) {
  return {"ball_radius", radius, "radius of the robot ball"};
}

SceneKnob FacesKnob() {
  return {"triangles", 320, "of the robot ball: 20·4^k"};
}

SceneKnob EdgeKnob() {
  return {"edge", 0.0,
          "longest edge of the obstacle as scanned; 0: as designed"};
}

// A family whose robot is a ball; the knobs are the others.
SceneRecipe BallBefore(const char* name, const char* meaning,
                       std::vector<SceneKnob> knobs,
                       SceneLayout (*make)(KnobValues& knobs)) {
  knobs.insert(knobs.begin(), {BallKnob(0.1), FacesKnob()});
  return {{name, meaning, std::move(knobs)}, make};
}

// One obstacle of each kind: traps, holes, walls.
std::vector<SceneRecipe> ShapeByShape() {
  return {
      BallBefore("u_trap", "a ball behind the closed side of a U",
                 {EdgeKnob(),
                  {"size", 2.0, "outer width of the U"},
                  {"wall", 0.2, "thickness of its walls"},
                  {"height", 1.0, "of the U"}},
                 UTrap),
      BallBefore("l", "a ball on the outer side of an L",
                 {{"size", 2.0, "length of both legs"},
                  {"width", 0.4, "of the legs"},
                  {"height", 1.0, "of the L"}},
                 LShape),
      {{"plate_hole",
        "a cube that fits through the square hole of a plate",
        {{"side", 2.0, "of the plate"},
         {"thickness", 0.2, "of the plate"},
         {"hole", 0.4, "side of the hole"},
         {"clearance", 0.04, "hole less cube; negative: it does not fit"}}},
       PlateHole},
      {{"torus_hole",
        "a ball that fits through a torus",
        {BallKnob(0.3),
         FacesKnob(),
         {"major_radius", 1.0, "centre of the tube"},
         {"minor_radius", 0.3, "of the tube"},
         {"around", 48, "corners along the tube"},
         {"across", 24, "corners across the tube"}}},
       TorusHole},
      BallBefore("thin_wall", "a ball before a thin wall",
                 {EdgeKnob(),
                  {"side", 2.0, "of the wall"},
                  {"thickness", 0.01, "of the wall"}},
                 ThinWall),
      {{"cube_vessel",
        "a cube in a hollow box with a window",
        {{"cube", 0.5, "side of the robot cube"},
         {"outer", 3.0, "side of the box"},
         {"inner", 2.0, "side of its cavity"},
         {"window", 0.8, "side of the opening; 0: none"}}},
       CubeVessel},
      BallBefore("ball_convex", "a ball and a convex prism",
                 {{"radius", 0.5, "of the prism"},
                  {"height", 1.0, "of the prism"},
                  {"sides", 6, "of the prism"}},
                 BallConvex),
  };
}

// Where the straight line is the worst start, or free space is narrow.
std::vector<SceneRecipe> HardLines() {
  return {
      BallBefore("u_axis", "a ball on a line through both arms of a U",
                 {EdgeKnob(),
                  {"size", 2.0, "outer width of the U"},
                  {"wall", 0.2, "thickness of its walls"},
                  {"height", 1.0, "of the U"}},
                 UAxis),
      BallBefore("plate", "a ball before a plate, which thin_wall is too",
                 {EdgeKnob(),
                  {"side", 2.0, "of the plate"},
                  {"thickness", 0.1, "of the plate"}},
                 ThinWall),
      BallBefore("long_plate", "a ball on a line along a plate, inside it",
                 {EdgeKnob(),
                  {"length", 3.0, "of the plate, along the line"},
                  {"width", 1.0, "of the plate"},
                  {"thickness", 0.1, "of the plate"}},
                 LongPlate),
      {{"peg_tunnel",
        "a cube that fits through a long square channel",
        {{"side", 1.0, "of the block"},
         {"length", 1.0, "of the channel"},
         {"channel", 0.25, "side of the channel"},
         {"clearance", 0.01, "channel less cube; negative: it does not fit"}}},
       PegTunnel},
      BallBefore(
          "clutter", "a ball among boxes in random poses",
          {{"boxes", 30, "number of obstacles"},
           {"box", 0.25, "largest half side; the least is a quarter of it"},
           {"reach", 1.0, "half-width of the cube that holds their centres"},
           {"layout", 1, "seed of the boxes"}},
          Clutter),
      BallBefore("knot", "a ball before a trefoil knot",
                 {{"size", 0.5, "of the knot, a third of its radius"},
                  {"tube", 0.15, "radius of the tube"},
                  {"around", 96, "corners along the tube"},
                  {"across", 12, "corners across the tube"}},
                 Knot),
  };
}

}  // namespace

std::vector<SceneRecipe> TrajectoryRecipes() {
  std::vector<SceneRecipe> all = ShapeByShape();
  for (SceneRecipe& recipe : HardLines()) all.push_back(std::move(recipe));
  return all;
}

}  // namespace phongpd
