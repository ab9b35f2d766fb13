// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A path with a name for the legend.
struct NamedPath {
  std::string name;
  std::vector<Eigen::Vector3d> points;
  bool is_free = true;
};

// What is drawn: the sharp edges of contact surfaces and of the robot (facets
// turn by more than 20°; all edges where none is sharp), and paths of the
// robot's position among them.
struct PathScene {
  std::string title;
  std::vector<TriangleMesh> contact_meshes;
  TriangleMesh robot;
  std::vector<NamedPath> paths;
};

// A still picture, seen obliquely from above; paths that collide are dashed.
std::string PathSvg(const PathScene& scene);

// A page of its own, nothing loaded from elsewhere: drag to turn, wheel to
// zoom, a slider moves the robot along the first path.
std::string PathPage(const PathScene& scene);

}  // namespace phongpd
