// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/rigid_scenes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "core/number_text.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

RobotPose Pose(const Vector3d& position,
               const Quaterniond& orientation = Quaterniond::Identity()) {
  return {position, orientation};
}

Quaterniond About(const Vector3d& axis, double angle) {
  return Quaterniond(AngleAxisd(angle, axis));
}

const Vector3d kX = Vector3d::UnitX(), kY = Vector3d::UnitY(),
               kZ = Vector3d::UnitZ();

// start, the poses between, goal.
void SetWitness(std::vector<RobotPose> between, RigidScene* scene) {
  scene->witness = {scene->start};
  for (const RobotPose& pose : between) scene->witness.push_back(pose);
  scene->witness.push_back(scene->goal);
}

// A peg of 1 × 1 × 4 through a square hole, across at start and goal.
RigidScene Peg(double play) {
  RigidScene s;
  s.robot = MakeBox({-0.5, -0.5, -2}, {0.5, 0.5, 2});
  s.obstacles = {MakePlateWithHole(16, 2, 1 + play)};
  s.start = Pose({1, 2, 4.5}, About(kX, kPi / 2));
  s.goal = Pose({-1, 1, -4.5}, About(kY, kPi / 2));
  s.bounds = {{-5, -5, -6}, {5, 5, 6}};
  s.clearance = 0.5 * play;
  SetWitness({Pose({0, 0, 4.5}), Pose({0, 0, -4.5})}, &s);
  return s;
}

// An L with arms of 4, 1 thick and wide, through a square hole: it has to turn
// about the hole's edge half way.
RigidScene Ell(double hole) {
  RigidScene s;
  s.robot = MakeL(4, 1, 1);
  for (Vector3d& v : s.robot.vertices) v -= Vector3d::Constant(0.5);
  s.obstacles = {MakePlateWithHole(24, 1, hole)};
  s.start = Pose({0, 0, 5});
  s.goal = Pose({0, 0, -5});
  s.bounds = {{-6, -6, -8}, {6, 6, 8}};
  s.clearance = 0.5 * (hole - 1);
  s.narrow = Pose({0, 0, -2}, About(kX, kPi / 2));  // one arm up through it
  return s;
}

// A ring on a bent tube that is closed at one end by a plate: along the tube,
// round the bend and off.
RigidScene Flange(double play) {
  constexpr double kTube = 0.6, kRing = 0.3, kBend = 2.0;
  constexpr int kSides = 16, kSteps = 8;
  std::vector<Vector3d> path = {{-6, 0, 0}, {-kBend, 0, 0}};
  RigidScene s;
  for (int i = 1; i < kSteps; ++i) {
    const double a = 0.5 * kPi * i / kSteps;
    path.emplace_back(kBend * (std::sin(a) - 1), kBend * (1 - std::cos(a)), 0);
  }
  path.emplace_back(0, kBend, 0);
  path.emplace_back(0, 6, 0);
  s.obstacles = {MakeTube(path, kTube, kSides),
                 MakeBox({-7, -1.6, -1.6}, {-6.05, 1.6, 1.6})};
  // The ring's hole is a polygon about the tube's circle, its edges before the
  // tube's corners.
  const double inner = kTube * (1 + play) / std::cos(kPi / kSides);
  s.robot = MakeTorus(inner + kRing, kRing, kSides, 8);
  const Quaterniond upright = About(kY, 0.5 * kPi) * About(kZ, kPi / kSides);
  s.start = Pose({-4.5, 0, 0}, upright);
  s.goal = Pose({3, 4, 1.5}, About(kX, 0.4));
  s.bounds = {{-9, -4, -4}, {6, 9, 4}};
  s.clearance = kTube * play;
  s.narrow = s.start;
  return s;
}

constexpr double kAlphaEnd = 2.0;  // of the α beyond the crossing

// The path of an α: a loop whose ends cross at (x, 0), at right angles, one
// above the other, and go on.  It lies in the planes z = ±h but for one slope
// on the far side, to which it goes straight: so a tube along it is not
// twisted, and has corners exactly above and below its ends' axes.
std::vector<Vector3d> AlphaPath(double h, double* x) {
  constexpr double kLoop = 2.0, kSlope = 0.8, kStraight = 0.4;
  constexpr int kSteps = 9;
  constexpr double kShift = kSlope + kStraight;
  *x = kLoop * std::sqrt(2.0) + kShift;
  const double end = kAlphaEnd / std::sqrt(2.0);
  std::vector<Vector3d> path = {{*x + end, end, -h}};
  // Two arcs of 135 degrees, from where the ends touch them to the far side.
  const auto arc = [](int i) {
    const double a = kPi * (0.25 + 0.75 * i / kSteps);
    return Vector3d(kLoop * std::cos(a), kLoop * std::sin(a) + kShift, 0);
  };
  for (int i = 0; i <= kSteps; ++i) {
    path.emplace_back(arc(i).x(), -arc(i).y(), -h);
  }
  path.emplace_back(-kLoop, -kSlope, -h);
  path.emplace_back(-kLoop, kSlope, h);
  for (int i = kSteps; i >= 0; --i) {
    path.emplace_back(arc(i).x(), arc(i).y(), h);
  }
  path.emplace_back(*x + end, -end, h);
  return path;
}

// Two equal tubes in the form of an α, each through the other's loop; they
// part where the ends cross, by a gap of `gap` times the tube's thickness.
RigidScene Alpha(double gap) {
  constexpr double kTube = 0.3;
  constexpr int kSides = 12;
  const double h = kTube * (1 + gap);
  double x = 0.0;
  const std::vector<Vector3d> path = AlphaPath(h, &x);
  RigidScene s;
  s.robot = MakeTube(path, kTube, kSides);
  s.obstacles = {s.robot};
  // Like two links of a chain.
  s.start = Pose({-2, 0, 0}, About(kX, 0.5 * kPi) * About(kZ, kPi));
  s.goal = Pose({-10, 0, 0});
  s.bounds = {{-12, -8, -8}, {12, 8, 8}};
  s.clearance = kTube * (gap - 1);
  // An end through the gap, halfway between the two tubes.
  const Quaterniond along_x = About(kZ, 0.75 * kPi);
  const Vector3d tip(x - 0.4 * kAlphaEnd, 0, 0);
  s.narrow = Pose(tip - along_x * path[0], along_x);
  return s;
}

// A rod in a box with one entrance, a square tunnel that leads inwards.
RigidScene BugTrap(double play) {
  constexpr double kRod = 0.4;
  const double w = 0.5 * kRod + play, wall = w + 0.2;
  const std::vector<double> x = {-3, -2.7, 1, 2.7, 3};
  const std::vector<double> yz = {-3, -2.7, -wall, -w, w, wall, 2.7, 3};
  std::vector<std::vector<std::string>> layers(7, std::vector<std::string>(7));
  for (int k = 0; k < 7; ++k) {
    for (int j = 0; j < 7; ++j) {
      const bool room = j >= 1 && j <= 5 && k >= 1 && k <= 5;
      const bool tube = j >= 2 && j <= 4 && k >= 2 && k <= 4;
      const bool bore = j == 3 && k == 3;
      std::string& row = layers[k][j];
      row = "#";
      row += room ? '.' : '#';
      row += room && (!tube || bore) ? '.' : '#';
      row += bore ? '.' : '#';
    }
  }
  RigidScene s;
  s.robot =
      MakeBox({-0.8, -0.5 * kRod, -0.5 * kRod}, {0.8, 0.5 * kRod, 0.5 * kRod});
  s.obstacles = {MakeCells(x, yz, yz, layers)};
  s.start = Pose({-1, 0.5, 0}, About(kZ, 0.5 * kPi));
  s.goal = Pose({5, 1, 0}, About(kY, 0.5 * kPi));
  s.bounds = {{-6, -6, -6}, {6, 6, 6}};
  s.clearance = play;
  s.narrow = Pose({2, 0, 0});
  SetWitness({Pose({-1, 0, 0}), Pose({5, 0, 0})}, &s);
  return s;
}

// A piano of 2.4 × 1.2 × 1 in a flat: out of a room by a door, a quarter turn
// in the hall, into the next room by a door.
RigidScene Piano(double play) {
  const double w = 0.6 + play;
  const std::vector<double> x = {-0.3, 0, 4, 4.3, 5.8 - w, 5.8 + w, 7.3, 7.6};
  const std::vector<double> y = {-0.3, 0, 1.8 - w, 1.8 + w, 4, 4.3, 8.3, 8.6};
  const std::vector<double> z = {-0.3, 0, 1.5, 2.2, 2.5};
  const std::vector<std::string> full(7, "#######");
  const std::vector<std::string> upper = {"#######", "#.#...#", "#.#...#",
                                          "#.#...#", "#######", "###...#",
                                          "#######"};
  std::vector<std::string> lower = upper;
  lower[2] = "#.....#";  // the door of the first room
  lower[4] = "####.##";  // and of the second
  RigidScene s;
  s.robot = MakeBox({-1.2, -0.6, -0.5}, {1.2, 0.6, 0.5});
  s.obstacles = {MakeCells(x, y, z, {full, lower, upper, full})};
  s.start = Pose({2, 2, 0.9}, About(kZ, 1.1));
  s.goal = Pose({5.8, 6.3, 0.9}, About(kZ, 0.3));
  s.bounds = {{0, 0, 0}, {7.3, 8.3, 2.2}};
  s.clearance = play;
  s.narrow = Pose({4.15, 1.8, 0.75});
  SetWitness({Pose({2, 1.8, 0.75}), Pose({5.8, 1.8, 0.75}),
              Pose({5.8, 1.8, 0.75}, About(kZ, 0.5 * kPi)),
              Pose({5.8, 6.3, 0.75}, About(kZ, 0.5 * kPi))},
             &s);
  return s;
}

// A plate with a slot for the key's bit and room in its middle for the shaft to
// turn.
TriangleMesh SlottedPlate(double long_half, double short_half, double bottom) {
  return MakeCells({-6, -long_half, -0.2, 0.2, long_half, 6},
                   {-6, -0.2, -short_half, short_half, 0.2, 6},
                   {bottom, bottom + 0.5},
                   {{"#####", "##.##", "#...#", "##.##", "#####"}});
}

// A key through two slots at right angles: in, a quarter turn, out.
RigidScene Lock(double play) {
  RigidScene s;
  s.robot = MakeCells({-0.5, -0.1, 0.1, 0.5}, {-0.1, 0.1}, {-0.2, 0.2, 4},
                      {{"###"}, {".#."}});
  TriangleMesh second = SlottedPlate(0.5 + play, 0.1 + play, -2);
  // A quarter turn, exactly.
  for (Vector3d& v : second.vertices) v = Vector3d(-v.y(), v.x(), v.z());
  s.obstacles = {SlottedPlate(0.5 + play, 0.1 + play, 0), second};
  s.start = Pose({0.5, 0.5, 2}, About(kZ, 0.5));
  s.goal = Pose({0.5, -0.5, -8}, About(kZ, 0.8));
  s.bounds = {{-3, -3, -9}, {3, 3, 6}};
  s.clearance = play;
  s.narrow = Pose({0, 0, 0.25});
  const Quaterniond quarter = About(kZ, 0.5 * kPi);
  SetWitness({Pose({0, 0, 2}), Pose({0, 0, -0.75}),
              Pose({0, 0, -0.75}, quarter), Pose({0, 0, -8}, quarter)},
             &s);
  return s;
}

// An easy one: a small L through a window with room to spare.
RigidScene Window(double side) {
  RigidScene s;
  s.robot = MakeL(2, 0.5, 0.5);
  for (Vector3d& v : s.robot.vertices) v -= Vector3d(1, 1, 0.25);
  s.obstacles = {MakePlateWithHole(16, 0.5, side)};
  s.start = Pose({2, 2, 3}, About(kX, 1.0));
  s.goal = Pose({-2, 1, -3}, About(kY, 2.0));
  s.bounds = {{-5, -5, -5}, {5, 5, 5}};
  s.clearance = 0.5 * side - 1;
  SetWitness({Pose({0, 0, 3}), Pose({0, 0, -3})}, &s);
  return s;
}

struct Recipe {
  RigidSceneFamily family;
  RigidScene (*make)(double value);
};

const std::vector<Recipe>& Recipes() {
  static const std::vector<Recipe> recipes = {
      {{"window", "a small L through a window; easy", "side",
        "side of the window", 4, 2.5, 10},
       Window},
      {{"piano", "a piano by two doors, with a turn in the hall", "play",
        "play on each side in a door", 0.1, 0.001, 0.25},
       Piano},
      {{"peg", "a square peg through a square hole, across at both ends",
        "play", "hole less peg", 0.1, 1e-5, 3},
       Peg},
      {{"ell", "an L through a square hole, turning about its edge", "hole",
        "side of the hole; the L is 1 thick", 2.2, 1.1, 5},
       Ell},
      {{"lock", "a key through two slots, with a quarter turn between", "play",
        "play on each side of the bit", 0.05, 1e-4, 0.09},
       Lock},
      {{"rod_trap", "a rod out of a box by a tunnel that leads inwards", "play",
        "play on each side in the tunnel", 0.1, 0.001, 0.5},
       BugTrap},
      {{"flange", "a ring along a bent tube and off", "play",
        "play, share of the tube's radius", 0.15, 0.01, 1},
       Flange},
      {{"alpha", "two tubes in the form of an alpha, to be parted", "gap",
        "gap where a tube crosses itself, over its thickness", 1.5, 1.01, 3},
       Alpha}};
  return recipes;
}

}  // namespace

const std::vector<RigidSceneFamily>& RigidSceneFamilies() {
  static const std::vector<RigidSceneFamily> families = [] {
    std::vector<RigidSceneFamily> result;
    for (const Recipe& recipe : Recipes()) result.push_back(recipe.family);
    return result;
  }();
  return families;
}

RigidScene MakeRigidScene(const std::string& name) {
  const std::size_t colon = std::min(name.find(':'), name.size());
  std::string family = name.substr(0, colon);
  if (family == "bugtrap") family = "rod_trap";
  std::vector<std::string> names;
  for (const Recipe& recipe : Recipes()) {
    const RigidSceneFamily& f = recipe.family;
    names.push_back(f.name);
    if (f.name != family) continue;
    double value = f.value;
    if (colon < name.size()) {
      value = ParseDouble(name.substr(colon + 1), "rigid scene " + f.name);
    }
    if (!(value >= f.min && value <= f.max)) {
      throw InputError("rigid scene " + f.name + ": " + f.knob +
                       ": expected a number in [" + Rounded(f.min) + ", " +
                       Rounded(f.max) + "], found " + Rounded(value));
    }
    RigidScene scene = recipe.make(value);
    scene.name = f.name + ":" + FormatDouble(value);
    return scene;
  }
  throw InputError("rigid scene: expected one of " + Joined(names) +
                   ", found '" + family + "'" + DidYouMean(family, names));
}

}  // namespace phongpd
