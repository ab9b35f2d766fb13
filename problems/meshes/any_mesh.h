// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

// Meshes in the formats that people have them in.
namespace phongpd {

// The formats of ReadAnyMesh, for messages: "OFF, OBJ, STL, PLY, ...".
extern const char* const kMeshFormats;

// Does the name say that it is a mesh for ReadAnyMesh?
bool NamesMesh(const std::string& path);

// How much of a mesh's name is the file's: what follows .urdf or .sdf as
// "#link" or "@joint=value,..." says what of it is meant.
std::size_t FilePartOf(const std::string& name);

// Reads, by the extension in any case:
//  - .off .obj .stl .ply: ReadMesh (core/mesh/mesh_io.h), in double precision.
//  - .dae .gltf .glb .3mf: all triangles of the scene, its nodes' transforms
//    applied, by Assimp, which keeps SINGLE precision.  Lengths and axes are
//    the file's own: no unit and no up axis is applied.
//  - .urdf .sdf: collision shapes of one link, in the link's frame, metres:
//    "robot.urdf#arm" names it, and "robot.urdf" will do where only one has
//    any.  Of a URDF, "robot.urdf@shoulder=0.5,elbow=-1" are all links with
//    the joints at these values, radians or metres, the others at 0
//    ("robot.urdf@": all), in the root link's frame (robot_pose.h).
//    Boxes, cylinders and spheres become meshes as our shapes do.  Mesh files
//    that they name must lie in the file's folder, or in one above it for
//    package:// and model:// names.
// What the user should know (precision, unit, axes, shapes, joints) is appended
// to *warnings, which may be null, each with the file's name.
//
// The result is as that of ReadMesh: valid indices, finite coordinates, no
// other promise.  A `root` that is not empty is a folder that all files must
// lie below, links and ".." followed; then all must be regular files.  Files
// that a glTF or COLLADA file names must be regular ones beside or below it,
// without links and "..", always (files_beside.h).  Assimp reads in a process
// of its own, with limits of memory and time by the file's size: what a file
// makes of it ends there.
//
// Throws InputError, one line "FILE: what, expected, found": what ReadMesh
// refuses; files that give no mesh; links that there are none of or several;
// a build without Assimp (PHONGPD_BUILD_ASSIMP).
TriangleMesh ReadAnyMesh(const std::string& path,
                         std::vector<std::string>* warnings = nullptr,
                         const std::string& root = "");

}  // namespace phongpd
