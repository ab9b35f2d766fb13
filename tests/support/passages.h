// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "planners/exact/workspace.h"
#include "planners/retraction/contact_model.h"

// Narrow passages with a knob: the free channel's side δ, in configuration
// space, in scenes of size 2.  δ < 0 closes the passage: the infeasible twin.
namespace phongpd::testing {

struct Passage {
  std::string name;
  Workspace workspace;
  Eigen::Vector3d start, goal;
};

// A cube and a square hole, δ × δ × 0.2 in q, through a plate.
Passage PlateHole(double delta);
// A cube and a tunnel with three bends through a block.
Passage Tunnel(double delta);
// Three crossed bars and two plus-shaped holes through a plate.
Passage Keyhole(double delta);
// A cube in a hollow island whose way out is a pipe that leads inwards.
Passage Bugtrap(double delta);

// Turned by GenericRotation (but for the bounds): coplanar coincidences go,
// rounding comes.
Passage Turned(Passage passage);

// C_cont of everything in the passage as one merged contact space.
TriangleMesh ContactMesh(const Passage& passage);
std::shared_ptr<const ContactModel> MakeModel(const Passage& passage);

}  // namespace phongpd::testing
