// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "core/mesh/triangle_mesh.h"

// A first scene of two meshes, for those who have no scene yet.
namespace phongpd {

// What a scene needs besides its meshes, guessed from their boxes.  With A the
// robot's box and B the obstacle's, the two can touch only at positions in
//
//   C = [min B − max A, max B − min A].
//
// Start and goal lie outside of C, on either side of it along x, so both are
// free and the line between them leads through the obstacle; the bounds hold C
// with so much room about it that a way around it is free.  All numbers are
// rounded to a hundredth of C's diagonal, or less.
struct SceneGuess {
  std::string unit;  // "m" or "mm"
  std::string why;   // that unit; one clause
  Eigen::Vector3d start, goal;
  BoundingBox bounds;  // of positions
};

// The unit is told by the format where that has one (URDF, SDF and glTF: m;
// 3MF: mm), else by size: 20 across or more are millimetres, as they come from
// CAD, less are metres.  Files are told by their names.  Throws InputError for
// a mesh without any extent.
SceneGuess GuessScene(const TriangleMesh& robot, const std::string& robot_file,
                      const TriangleMesh& obstacle,
                      const std::string& obstacle_file);

// The scene file (JSON with comments, scene.schema.json) that says what is
// guessed and what may be added.  The files are named as the scene is to name
// them; `repair` is its key of that name: reject, safe or wrap.
std::string NewSceneText(const SceneGuess& guess, const std::string& robot_file,
                         const std::string& obstacle_file,
                         const std::string& repair = "reject");

}  // namespace phongpd
