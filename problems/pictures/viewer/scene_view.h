// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "problems/pictures/viewer/view.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// The scene's robot and obstacles, start and goal, and contact spaces that were
// built for it.
View SceneView(const Scene& scene,
               const std::vector<TriangleMesh>& contact_spaces = {});

}  // namespace phongpd
