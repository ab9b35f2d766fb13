// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/new_scene.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "problems/meshes/any_mesh.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Parts in millimetres are seldom smaller, rooms in metres seldom larger.
constexpr double kLeastMillimetres = 20.0;

// Shares of C's diagonal: what is rounded to, the room between C and start or
// goal, and that between C and the bounds.
constexpr double kGuessStep = 0.01;
constexpr double kStartGap = 0.1;
constexpr double kBoundsRoom = 0.2;

std::string MeshEndingOf(const std::string& name) {
  std::string extension =
      std::filesystem::path(name.substr(0, FilePartOf(name)))
          .extension()
          .string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension;
}

// To a power of ten that is at most kGuessStep of the diagonal, so that its
// decimal text is short.
Vector3d RoundedPoint(const Vector3d& point, double diagonal) {
  const double digits = std::floor(std::log10(kGuessStep * diagonal));
  const double step = std::pow(10.0, std::abs(digits));  // exact up to 1e22
  return point.unaryExpr([&](double x) {
    const double rounded = digits < 0.0 ? std::round(x * step) / step
                                        : std::round(x / step) * step;
    return rounded == 0.0 ? 0.0 : rounded;  // no -0
  });
}

void GuessUnit(const std::string& robot_file, const std::string& obstacle_file,
               double size, SceneGuess* guess) {
  for (const std::string& file : {robot_file, obstacle_file}) {
    const std::string extension = MeshEndingOf(file);
    const bool is_metres = extension == ".urdf" || extension == ".sdf" ||
                           extension == ".gltf" || extension == ".glb";
    if (!is_metres && extension != ".3mf") continue;
    guess->unit = is_metres ? "m" : "mm";
    guess->why = "as " + extension + " files are in it";
    return;
  }
  const bool is_small = size < kLeastMillimetres;
  guess->unit = is_small ? "m" : "mm";
  guess->why = "as the larger mesh is " + Rounded(size) +
               " across; CAD files " + "of " + Rounded(kLeastMillimetres) +
               " or more are mostly in mm";
}

std::string Quoted(const std::string& text) {
  return nlohmann::ordered_json(text).dump(
      -1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

std::string GuessText(const Vector3d& point) {
  return "[" + FormatDouble(point.x()) + ", " + FormatDouble(point.y()) + ", " +
         FormatDouble(point.z()) + "]";
}

std::string MeshKeys(const std::string& file, const std::string& repair) {
  return "\"mesh\": " + Quoted(file) +
         (repair == "reject" ? "" : ", \"repair\": " + Quoted(repair));
}

}  // namespace

SceneGuess GuessScene(const TriangleMesh& robot, const std::string& robot_file,
                      const TriangleMesh& obstacle,
                      const std::string& obstacle_file) {
  const BoundingBox a = ComputeBounds(robot), b = ComputeBounds(obstacle);
  const BoundingBox contact = {b.min - a.max, b.max - a.min};
  const double diagonal = contact.Diagonal();
  if (a.IsEmpty() || b.IsEmpty() || !(diagonal > 0.0)) {
    throw InputError(robot_file + ", " + obstacle_file +
                     ": expected meshes of some size, found a point");
  }
  SceneGuess guess;
  GuessUnit(robot_file, obstacle_file, std::max(a.Diagonal(), b.Diagonal()),
            &guess);
  const Vector3d middle = 0.5 * (contact.min + contact.max);
  guess.start = guess.goal = middle;
  guess.start.x() = contact.min.x() - kStartGap * diagonal;
  guess.goal.x() = contact.max.x() + kStartGap * diagonal;
  const Vector3d room = Vector3d::Constant(kBoundsRoom * diagonal);
  guess.bounds = {contact.min - room, contact.max + room};
  for (Vector3d* const point :
       {&guess.start, &guess.goal, &guess.bounds.min, &guess.bounds.max}) {
    *point = RoundedPoint(*point, diagonal);
  }
  return guess;
}

std::string NewSceneText(const SceneGuess& guess, const std::string& robot_file,
                         const std::string& obstacle_file,
                         const std::string& repair) {
  const double speed =
      std::pow(10.0, std::round(std::log10((guess.goal - guess.start).norm())));
  const std::string unit = guess.unit;
  return R"(// Written by phongpd new.  Every guess is for you to correct; then
//   phongpd plan FILE                     a path, or a proof that there is none
//   phongpd optimize FILE --html page.html     a short one, to look at
{
  // A guess, )" +
         guess.why + R"(.
  // Nothing is converted: it says what the numbers of both files are in.
  "unit": )" +
         Quoted(unit) + R"(,

  // What moves, without turning.  At position q it is its mesh moved by q.
  "robot": { )" +
         MeshKeys(robot_file, repair) + R"( },
  // What stays; add more after a comma.  "position": [x, y, z] moves one,
  // "scale": 1000 makes mm of m.
  "obstacles": [ { "id": "obstacle", )" +
         MeshKeys(obstacle_file, repair) + R"( } ],

  // Guesses: on both sides of the obstacle along x, clear of its box.
  "start": )" +
         GuessText(guess.start) + R"(,
  "goal": )" +
         GuessText(guess.goal) + R"(,
  // A guess: where q may be, with room to pass around the obstacle.
  "bounds": { "min": )" +
         GuessText(guess.bounds.min) + R"(,
              "max": )" +
         GuessText(guess.bounds.max) + R"( }

  // For a motion in time, in )" +
         unit + R"( and seconds; put the limits of your machine:
  // , "limits": { "velocity": )" +
         FormatDouble(speed) +
         ", \"acceleration\": " + FormatDouble(4.0 * speed) +
         ", \"jerk\": " + FormatDouble(40.0 * speed) + R"( }
  // Distance to keep where there is room, a share of the world's diagonal D:
  // , "trajectory": { "margin": "0.01D" }
}
)";
}

}  // namespace phongpd
