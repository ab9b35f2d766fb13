// SPDX-License-Identifier: GPL-3.0-or-later
// Narrow passages for planners: q in [−1, 1]³, free channels exactly `delta`
// wide (scene_carving.h), infeasible twins with channels slightly too narrow.

#include <algorithm>
#include <cmath>
#include <utility>

#include "problems/output/text.h"
#include "problems/scenes/scene_carving.h"
#include "problems/scenes/scene_maze.h"
#include "problems/scenes/scene_recipes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;
using Layout = SceneLayout;
using Path = std::vector<Vector3d>;
using Values = KnobValues;

// Blocks end beyond the bounds, so that nothing goes round them; free boxes
// end beyond the blocks.
constexpr double kBlock = 1.5, kBeyond = 3.0;
// Width of the twins' channels.
constexpr double kTooNarrow = -1e-4;

BoundingBox Cube(double half) {
  return {Vector3d::Constant(-half), Vector3d::Constant(half)};
}

// Configurations with x in [min, max], any y and z.
BoundingBox Slab(double min, double max) {
  return {{min, -kBeyond, -kBeyond}, {max, kBeyond, kBeyond}};
}

// Wider channels than `most` would leave walls that the robot's sweep eats.
double Width(const Values& v, double most = 0.1) {
  const double delta = v.at("delta");
  if (!(delta >= -0.05 && delta <= most)) {
    throw InputError("delta: expected a number in [-0.05, " +
                     FormatDouble(most) + "], found " + FormatDouble(delta));
  }
  return v.at("twin") != 0.0 ? kTooNarrow : delta;
}

// An L in the xz plane, one box thick.
Boxes Hook() {
  constexpr double h = 1.0 / 32, foot = 3.0 / 32, bar = 5.0 / 32;
  return {{{-h, -h, -h}, {foot, h, h}}, {{-h, -h, -h}, {h, h, bar}}};
}

// The block less what the robot sweeps in `free`; start, passage and goal are
// the points of `path`.
Layout Passage(const Boxes& robot, const Boxes& free, const Path& path,
               double width, double freedom) {
  Layout layout;
  layout.robot = CellsShape(robot);
  layout.obstacles = {{"block", CarvedShape(Cube(kBlock), free, robot),
                       Vector3d::Zero(), std::nullopt}};
  layout.bounds = Cube(1.0);
  layout.start = path.front();
  layout.goal = path.back();
  layout.route = SceneRoute::kPassage;
  layout.passage.assign(path.begin() + 1, path.end() - 1);
  layout.is_feasible = width > 0.0;
  layout.is_sealed = true;
  layout.freedom = freedom;
  return layout;
}

// Half the thickness of plates, and half the side of the cube.
constexpr double kPlate = 1.0 / 8, kCube = 1.0 / 16;
constexpr double kRoom = 1.0 / 8;  // freedom in rooms

Layout Gap(Values& v) {
  const double w = Width(v);
  const BoundingBox gap = {{-kPlate, -kBeyond, 0.25 - 0.5 * w},
                           {kPlate, kBeyond, 0.25 + 0.5 * w}};
  return Passage({Cube(kCube)},
                 {Slab(-kBeyond, -kPlate), Slab(kPlate, kBeyond), gap},
                 {{-0.75, 0, -0.25},
                  {-0.375, 0, 0.25},
                  {0.375, 0, 0.25},
                  {0.75, 0, -0.25}},
                 w, kRoom);
}

// Rooms left and right of a plate, joined by channels along x at the given
// places; the path takes the first.
Layout PlateWithChannels(const Boxes& robot, const Path& places, double w,
                         Boxes free = {}) {
  free.insert(free.end(), {Slab(-kBeyond, -kPlate), Slab(kPlate, kBeyond)});
  for (const Vector3d& p : places) {
    const Vector3d along(kPlate, 0, 0);
    free.push_back(Channel({p - along, p + along}, w)[0]);
  }
  const Vector3d out(0.375, 0, 0), &p = places[0];
  return Passage(robot, free, {{-0.75, 0, 0}, p - out, p + out, {0.75, 0, 0}},
                 w, kRoom);
}

Layout Hole(Values& v) {
  return PlateWithChannels({Cube(kCube)}, {{0, 0.25, -0.125}}, Width(v));
}

Layout Keyhole(Values& v) {
  constexpr double arm = 3.0 / 16, h = 1.0 / 16;
  const Boxes plus = {{{-h, -arm, -h}, {h, arm, h}},
                      {{-h, -h, -arm}, {h, h, arm}}};
  return PlateWithChannels(plus, {{0, 0.5, 0}, {0, -0.5, 0}}, Width(v));
}

Layout ClutterHole(Values& v) {
  // The decoy is too narrow by ten times the twins' lack.
  const Path decoy = {{-kPlate, -0.5, -0.25}, {kPlate, -0.5, -0.25}};
  Layout layout = PlateWithChannels({Cube(kCube)}, {{0, 0.5, 0.25}}, Width(v),
                                    Channel(decoy, 10.0 * kTooNarrow));
  Path path = layout.passage;
  path.insert(path.begin(), layout.start);
  path.push_back(layout.goal);
  const double apart = 2.0 * kCube + std::sqrt(3.0) * layout.freedom;
  for (PlacedShape& box : RandomBoxes(
           static_cast<int>(WholeKnob(v, "boxes", 0, 1000)), 0.05, 0.15, 0.9,
           apart, path,
           static_cast<std::uint64_t>(WholeKnob(v, "layout", 0, 1e15)))) {
    layout.obstacles.push_back(std::move(box));
  }
  return layout;
}

// Rooms left and right of a block with a channel through it.
Layout Snake(Values& v) {
  const double w = Width(v);
  const Path bends = {{-0.5, -0.5, 0},   {-0.25, -0.5, 0}, {-0.25, 0.5, 0},
                      {0, 0.5, 0},       {0, 0.5, 0.5},    {0.25, 0.5, 0.5},
                      {0.25, -0.5, 0.5}, {0.5, -0.5, 0.5}};
  Boxes free = Channel(bends, w);
  free.push_back(Slab(-kBeyond, -0.5));
  free.push_back(Slab(0.5, kBeyond));
  Path path = {{-0.75, 0, 0}, {-0.75, -0.5, 0}};
  path.insert(path.end(), bends.begin(), bends.end());
  path.insert(path.end(), {{0.75, -0.5, 0.5}, {0.75, 0, 0}});
  return Passage(Hook(), free, path, w, kRoom);
}

// From a room on the left through a channel into a room within the block.
Layout Tunnel(Values& v) {
  const double w = Width(v);
  const double count = v["bends"];
  Path bends;
  if (count == 1) {
    bends = {{-0.5, -0.75, 0}};
  } else if (count == 3) {
    bends = {{-0.5, -0.75, -0.5}, {-0.125, -0.75, -0.5}, {-0.125, -0.75, 0}};
  } else if (count == 5) {
    bends = {{-0.5, 0.25, -0.5},
             {-0.25, 0.25, -0.5},
             {-0.25, -0.75, -0.5},
             {0, -0.75, -0.5},
             {0, -0.75, 0}};
  } else {
    throw InputError("bends: expected 1, 3 or 5, found " + FormatDouble(count));
  }
  bends.insert(bends.end(), {{0.5, -0.75, 0}, {0.5, -0.25, 0}});
  Boxes free = Channel(bends, w);
  free.push_back(Slab(-kBeyond, -0.5));
  free.push_back({{0.25, -0.25, -0.25}, {0.75, 0.25, 0.25}});
  const Vector3d& entry = bends[0];
  Path path = {{-0.75, 0, 0}, {-0.75, entry.y(), entry.z()}};
  path.insert(path.end(), bends.begin(), bends.end());
  path.push_back({0.5, 0, 0});
  return Passage({Cube(kCube)}, free, path, w, kRoom);
}

// Three plates that reach past each other between two rooms; a hook goes up,
// down and up.
Layout Comb(Values& v) {
  const double w = Width(v), x = 0.25, turn = 0.75, h = 0.5 * w;
  constexpr double all = kBeyond;
  const Boxes free = {Slab(-all, -0.5),
                      Slab(0.5, all),
                      Slab(-x - h, -x + h),
                      Slab(x - h, x + h),
                      {{-all, -all, turn}, {-x + h, all, all}},
                      {{-x - h, -all, -all}, {x + h, all, -turn}},
                      {{x - h, -all, turn}, {all, all, all}}};
  const double top = 0.875;
  return Passage(Hook(), free,
                 {{-0.75, 0, 0},
                  {-0.75, 0, top},
                  {-x, 0, top},
                  {-x, 0, -top},
                  {x, 0, -top},
                  {x, 0, top},
                  {0.75, 0, top},
                  {0.75, 0, 0}},
                 w, kRoom);
}

// Out of a hollow cube through a pipe that reaches into it.
Layout Bugtrap(Values& v) {
  const double w = Width(v);
  constexpr double outer = 0.5, inner = 0.375, pipe = 0.125;
  Boxes free = Channel({{0, 0, 0}, {outer, 0, 0}}, w);
  free.push_back({{-inner, -inner, -inner}, {0, inner, inner}});
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool is_max : {false, true}) {
      BoundingBox outside = Cube(kBeyond), beside = Cube(inner);
      (is_max ? outside.min : outside.max)[axis] = is_max ? outer : -outer;
      free.push_back(outside);
      if (axis == 0) continue;
      (is_max ? beside.min : beside.max)[axis] = is_max ? pipe : -pipe;
      free.push_back(beside);
    }
  }
  return Passage(
      {Cube(1.0 / 32)}, free,
      {{-0.25, 0.125, 0.125}, {-0.25, 0, 0}, {0.75, 0, 0}, {0.75, 0.5, -0.25}},
      w, 1.0 / 16);
}

Layout MazeScene(Values& v) {
  const int n = static_cast<int>(WholeKnob(v, "n", 2, 12));
  const Maze maze = RandomMaze(
      n, static_cast<std::uint64_t>(WholeKnob(v, "layout", 0, 1e15)));
  const int last = n * n * n - 1;
  Path path;
  for (int node = last; node != 0; node = maze.parent[node]) {
    path.push_back(maze.Place(node));
  }
  path.push_back(maze.Place(0));
  // Walls stay thicker than the cube.
  const double most = std::min(0.1, 1.4 / (n - 1) - 1.0 / 16);
  // Only one corridor on the way is too narrow.
  const double w = Width(v, most), others = std::abs(v["delta"]);
  Boxes free;
  for (int node = 1; node <= last; ++node) {
    const Path corridor = {maze.Place(maze.parent[node]), maze.Place(node)};
    free.push_back(Channel(corridor, node == last ? w : others)[0]);
  }
  // The dead end behind it is as wide as the others.
  free.push_back(Channel({maze.Place(last), maze.Place(last)}, others)[0]);
  return Passage({Cube(1.0 / 32)}, free, path, w, 0.25 * others);
}

}  // namespace

std::vector<SceneRecipe> PlanningRecipes() {
  const SceneKnob twin = {"twin", 0, "1: the channel is too narrow by 1e-4"};
  const SceneKnob layout = {"layout", 1, "seed of it"};
  const auto delta = [](double value) {
    return SceneKnob{"delta", value,
                     "side of the free channel in q; negative: infeasible"};
  };
  return {
      {{"gap", "a cube and a slot between two plates", {delta(0.05), twin}},
       Gap},
      {{"hole", "a cube and a square hole in a plate", {delta(0.02), twin}},
       Hole},
      {{"tunnel",
        "a cube and a channel with bends into a closed room",
        {delta(0.001), twin, {"bends", 3, "1, 3 or 5"}}},
       Tunnel},
      {{"keyhole",
        "a plus-shaped peg and two holes of its form in a plate",
        {delta(0.001), twin}},
       Keyhole},
      {{"comb", "a hook and three interlocked plates", {delta(0.02), twin}},
       Comb},
      {{"snake", "a hook and a channel with six bends", {delta(0.001), twin}},
       Snake},
      {{"bugtrap",
        "a cube in a hollow cube with a pipe that reaches into it",
        {delta(0.001), twin}},
       Bugtrap},
      {{"clutter_hole",
        "a plate with a hole, one slightly too small, and boxes",
        {delta(0.02), twin, {"boxes", 30, "in random poses"}, layout}},
       ClutterHole},
      {{"maze",
        "a cube in a perfect maze of n³ nodes",
        {delta(0.02), twin, {"n", 3, "nodes along each axis"}, layout}},
       MazeScene},
  };
}

}  // namespace phongpd
