// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "problems/scenes/scene_library.h"

// How the families of scene_library.h are made; internal to it.
namespace phongpd {

struct PlacedShape {
  std::string id;
  nlohmann::ordered_json shape;  // see scene_shapes.h
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::optional<Eigen::Matrix3d> rotation;  // before the position
};

// How a free path from start to goal is known.
enum class SceneRoute {
  kAround,   // round the bounding box of the whole contact space
  kPassage,  // start, the points of `passage`, goal
};

// What differs from family to family; the common knobs are applied to it.
struct SceneLayout {
  nlohmann::ordered_json robot;
  std::vector<PlacedShape> obstacles;
  BoundingBox bounds;
  Eigen::Vector3d start;
  Eigen::Vector3d goal;
  SceneRoute route = SceneRoute::kAround;
  std::vector<Eigen::Vector3d> passage;
  bool is_feasible = true;  // kPassage: false is a proof by construction
  // The path must not leave the bounds: they stay a part of the problem when
  // the scene is rotated.
  bool is_sealed = false;
  // Every point that differs from start or goal by at most this in each
  // coordinate is free and sees it.  0: seeds choose directions instead.
  double freedom = 0.0;
};

using KnobValues = std::map<std::string, double>;

// A family and how its knobs become a layout.
struct SceneRecipe {
  SceneFamily family;
  SceneLayout (*make)(KnobValues& knobs);
};

// All families, the paper's three first.
const std::vector<SceneRecipe>& SceneRecipes();

// Their parts: the paper's benchmarks; one obstacle or a heap of boxes, for
// trajectories; narrow passages in [−1, 1]³, for planners.
std::vector<SceneRecipe> PaperRecipes();
std::vector<SceneRecipe> TrajectoryRecipes();
std::vector<SceneRecipe> PlanningRecipes();

// Counts are written as whole numbers; anything else stays as it is for
// MakeShape to refuse.
nlohmann::ordered_json CountJson(double value);

// A knob that must be a whole number in [least, most]; throws InputError.
double WholeKnob(const KnobValues& knobs, const char* key, double least,
                 double most);

// One obstacle in cubic bounds of half-width `reach`.
SceneLayout OneObstacle(nlohmann::ordered_json robot,
                        nlohmann::ordered_json shape,
                        const Eigen::Vector3d& position, double reach,
                        const Eigen::Vector3d& start,
                        const Eigen::Vector3d& goal);

// `count` boxes in random poses with half-sizes in [least, most] and centres
// uniform in the cube of half-width `reach`.  Boxes whose bounding sphere
// comes closer than `distance` to the polyline are drawn again.
std::vector<PlacedShape> RandomBoxes(
    int count, double least, double most, double reach, double distance,
    const std::vector<Eigen::Vector3d>& polyline, std::uint64_t seed);

}  // namespace phongpd
