// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "planners/world/world.h"
#include "problems/scenes/fleet_scene.h"
#include "problems/scenes/scene.h"
#include "viewer/view.h"

namespace phongpd {

// The scene's robot and obstacles, also those that move, start and goal, the
// name of its unit, and contact spaces that were built for it.
View SceneView(const Scene& scene,
               const std::vector<TriangleMesh>& contact_spaces = {});
// Of several robots what they have in common, and each at its start, as a path
// of one point with its name.
View FleetSceneView(const FleetScene& scene);
// The same with the part of the contact space that was built.
View ExploredView(const Scene& scene, const TriangleMesh& explored);
// The same with all that free space's model has of a contact space; none in a
// world without obstacles.
View WindowView(const Scene& scene, const World& world);

}  // namespace phongpd
