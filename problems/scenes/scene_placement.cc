// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_placement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "constraints/motion_oracle.h"
#include "problems/output/text.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/scene_detour.h"
#include "problems/scenes/scene_library.h"
#include "problems/shapes/random_solids.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;
using Path = std::vector<Vector3d>;

Json PointJson(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

// p ↦ scale · rotation · p + offset.
struct Placement {
  Matrix3d rotation = Matrix3d::Identity();
  bool is_rotated = false;
  double scale = 1.0;
  double offset = 0.0;

  Vector3d Moved(const Vector3d& p) const {
    const Vector3d turned = is_rotated ? Vector3d(rotation * p) : p;
    return (scale * turned).array() + offset;
  }
};

// A solid of the scene file; `position` is where its origin goes.
Json SolidJson(const Json& shape, const Vector3d& position,
               const std::optional<Matrix3d>& own_rotation,
               const Placement& placement) {
  Json solid = {{"shape", shape}};
  if (!position.isZero(0.0)) solid["position"] = PointJson(position);
  if (own_rotation || placement.is_rotated) {
    const Matrix3d rotation =
        placement.rotation * own_rotation.value_or(Matrix3d::Identity());
    Json rows = Json::array();
    for (int i = 0; i < 9; ++i) rows.push_back(rotation(i / 3, i % 3));
    solid["rotation"] = rows;
  }
  if (placement.scale != 1.0) solid["scale"] = placement.scale;
  return solid;
}

// Robot, obstacles, start and goal; enough for ParseScene.
Json SolidsJson(const SceneLayout& layout, const Placement& placement) {
  Json obstacles = Json::array();
  for (const PlacedShape& obstacle : layout.obstacles) {
    Json solid = {{"id", obstacle.id}};
    solid.update(SolidJson(obstacle.shape, placement.Moved(obstacle.position),
                           obstacle.rotation, placement));
    obstacles.push_back(solid);
  }
  return {{"robot",
           SolidJson(layout.robot, Vector3d::Zero(), std::nullopt, placement)},
          {"obstacles", obstacles},
          {"start", PointJson(placement.Moved(layout.start))},
          {"goal", PointJson(placement.Moved(layout.goal))}};
}

// Bounding box of the contact space of all obstacles, not placed.
BoundingBox ContactBounds(const Scene& scene) {
  const BoundingBox robot = ComputeBounds(scene.workspace.robot);
  const BoundingBox obstacle = ComputeBounds(JoinedObstacle(scene.workspace));
  return {obstacle.min - robot.max, obstacle.max - robot.min};
}

// Start and goal on a sphere that holds the contact space, opposite each
// other up to 0.3 rad.
void DrawDirection(const Scene& scene, std::mt19937_64* random,
                   SceneLayout* layout) {
  const BoundingBox box = ContactBounds(scene);
  const double radius = 0.55 * box.Diagonal();
  const MotionOracle oracle(scene.workspace.robot,
                            JoinedObstacle(scene.workspace));
  std::uniform_real_distribution<double> tilt(-0.3, 0.3);
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3d frame = RandomRotation(random);
    const Vector3d u = frame.col(0);
    const Vector3d v = Eigen::AngleAxisd(tilt(*random), frame.col(1)) * u;
    layout->start = box.Center() - radius * u;
    layout->goal = box.Center() + radius * v;
    if (oracle.Collides(layout->start, layout->goal)) return;
  }
  throw InputError("seed: no straight line collides");
}

// Start and goal within the layout's freedom; the path goes through the old
// ones.
void DrawNearby(std::mt19937_64* random, SceneLayout* layout) {
  std::uniform_real_distribution<double> move(-layout->freedom,
                                              layout->freedom);
  const auto moved = [&](const Vector3d& p) {
    const double x = move(*random), y = move(*random), z = move(*random);
    return Vector3d(p + Vector3d(x, y, z));
  };
  layout->passage.insert(layout->passage.begin(), layout->start);
  layout->passage.push_back(layout->goal);
  layout->start = moved(layout->start);
  layout->goal = moved(layout->goal);
}

void Extend(const Path& path, double margin, BoundingBox* box) {
  for (const Vector3d& p : path) {
    box->min = box->min.cwiseMin(p - Vector3d::Constant(margin));
    box->max = box->max.cwiseMax(p + Vector3d::Constant(margin));
  }
}

// The bounds as an obstacle: robot + q stays in its cavity iff q does.
PlacedShape BoundsShellShape(const SceneLayout& layout, const Scene& scene) {
  const BoundingBox robot = ComputeBounds(scene.workspace.robot);
  const BoundingBox cavity = {layout.bounds.min + robot.min,
                              layout.bounds.max + robot.max};
  return {"bounds_shell",
          {{"type", "box_shell"},
           {"min", PointJson(cavity.min)},
           {"max", PointJson(cavity.max)},
           {"thickness", 0.25 * cavity.Diagonal()}},
          Vector3d::Zero(),
          std::nullopt};
}

BoundingBox MovedBounds(const BoundingBox& box, const Placement& placement) {
  BoundingBox moved = {placement.Moved(box.min), placement.Moved(box.min)};
  for (int corner = 1; corner < 8; ++corner) {
    Vector3d p = box.min;
    for (int axis = 0; axis < 3; ++axis) {
      if (corner >> axis & 1) p[axis] = box.max[axis];
    }
    Extend({placement.Moved(p)}, 0.0, &moved);
  }
  return moved;
}

std::uint64_t Seed(const KnobValues& knobs, const char* key) {
  const double value = knobs.at(key);
  constexpr double kLargest = 1e15;
  if (value >= 0.0 && value <= kLargest && value == std::floor(value)) {
    return static_cast<std::uint64_t>(value);
  }
  throw InputError(std::string(key) + ": expected a whole number >= 0, found " +
                   FormatDouble(value));
}

Placement MakePlacement(const KnobValues& knobs) {
  Placement placement;
  placement.scale = knobs.at("scale");
  placement.offset = knobs.at("offset");
  if (!(placement.scale > 0.0) || !std::isfinite(placement.scale)) {
    throw InputError("scale: expected a number > 0, found " +
                     FormatDouble(placement.scale));
  }
  if (const std::uint64_t seed = Seed(knobs, "rotation_seed"); seed > 0) {
    std::mt19937_64 random(seed);
    placement.rotation = RandomRotation(&random);
    placement.is_rotated = true;
  }
  return placement;
}

Json Assembled(const std::string& name, SceneLayout layout,
               const KnobValues& knobs) {
  const Placement placement = MakePlacement(knobs);
  const std::uint64_t seed = Seed(knobs, "seed");
  const bool is_around = layout.route == SceneRoute::kAround;
  Scene scene;
  if (is_around || (layout.is_sealed && placement.is_rotated)) {
    scene = ParseScene(SolidsJson(layout, {}), "scene " + name);
  }
  if (seed > 0) {
    std::mt19937_64 random(seed);
    if (layout.freedom > 0.0) {
      DrawNearby(&random, &layout);
    } else {
      DrawDirection(scene, &random, &layout);
    }
  }
  Path witness;
  if (is_around) {
    const BoundingBox contact = ContactBounds(scene);
    witness = PathAround(layout.start, layout.goal, contact);
    Extend(witness, 0.05 * contact.Diagonal(), &layout.bounds);
  } else if (layout.is_feasible) {
    witness = layout.passage;
    witness.insert(witness.begin(), layout.start);
    witness.push_back(layout.goal);
  }
  const bool has_shell = layout.is_sealed && placement.is_rotated;
  if (has_shell) layout.obstacles.push_back(BoundsShellShape(layout, scene));

  Json json = {{"name", name}};
  json.update(SolidsJson(layout, placement));
  if (!has_shell) {
    const BoundingBox bounds = MovedBounds(layout.bounds, placement);
    json["bounds"] = {{"min", PointJson(bounds.min)},
                      {"max", PointJson(bounds.max)}};
  }
  json["penetration"] = {{"metric", "phong"},
                         {"field", "normal"},
                         {"smoothing_length", kDefaultSmoothingLength},
                         {"jacobian", "direction"}};
  if (!is_around || !witness.empty()) {
    json["feasible"] = !witness.empty();
  }
  for (const Vector3d& p : witness) {
    json["witness"].push_back(PointJson(placement.Moved(p)));
  }
  return json;
}

}  // namespace

const std::vector<SceneKnob>& CommonSceneKnobs() {
  static const std::vector<SceneKnob> knobs = {
      {"seed", 0, "of random start and goal; 0: the family's own"},
      {"rotation_seed", 0, "of a rotation of everything; 0: none"},
      {"offset", 0, "added to every coordinate of obstacles and points"},
      {"scale", 1, "of everything"}};
  return knobs;
}

Json PlacedScene(const SceneRecipe& recipe, KnobValues knobs) {
  const std::string& name = recipe.family.name;
  try {
    return Assembled(name, recipe.make(knobs), knobs);
  } catch (const InputError& error) {
    const std::string place = "scene " + name, message = error.what();
    if (message.rfind(place, 0) == 0) throw;
    throw InputError(place + ": " + message);
  }
}

}  // namespace phongpd
