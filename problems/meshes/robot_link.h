// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The collision shapes of one link of a URDF or SDF file, "FILE#link", as one
// mesh, or those of all links, "FILE@joint=value,...", with its joints at these
// values (robot_pose.h); see ReadAnyMesh.  Of one link:
//  - A pose of the shape in its link is applied; poses of links and joints are
//    not.
// Of both:
//  - Cylinders have kCylinderSides sides and spheres 1,280 triangles, their
//    vertices on the true surface: they lie within it.
//  - Mesh files: scaled as the file says; COLLADA by its unit, too, not turned.
TriangleMesh ReadRobotLink(const std::string& path, const std::string& root,
                           std::vector<std::string>* warnings);

// The same of a file's bytes; `part` is what of it is meant: "", "#link" or
// "@joint=value,...".
TriangleMesh ParseRobot(const std::string& bytes, const std::string& file,
                        const std::string& part, const std::string& root,
                        std::vector<std::string>* warnings);

inline constexpr int kCylinderSides = 64;
inline constexpr int kSphereLevels = 3;

}  // namespace phongpd
