// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

// Meshes in many formats: those of core/mesh/mesh_io.h, and some that Assimp
// and our readers of robot descriptions know.
namespace phongpd {

// The list of ReadAnyMesh's formats, for messages: "OFF, OBJ, STL, PLY, ...".
extern const char* const kMeshFormats;

// Does the extension of this name belong to a format of ReadAnyMesh?
bool NamesMesh(const std::string& path);

// The length of the file's own name in a mesh's name.  After .urdf or .sdf may
// follow "#link" or "@joint=value,...", see ReadAnyMesh.
std::size_t FilePartOf(const std::string& name);

// Reads a mesh file, told by its extension in any case:
//  - .off .obj .stl .ply: by ReadMesh (core/mesh/mesh_io.h), in double
//    precision.
//  - .dae .gltf .glb .3mf: by Assimp, which keeps SINGLE precision.  The mesh
//    is all triangles of the file, with the transforms of its nodes applied.
//    Lengths and axes are the file's own: neither the unit nor the up axis that
//    it names is applied.
//  - .urdf .sdf: the collision shapes of one link, in the link's frame, metres.
//    "robot.urdf#arm" is the link `arm`; "robot.urdf" is enough if only one
//    link has shapes.  "robot.urdf@shoulder=0.5,elbow=-1" (URDF only) is all
//    links with the joints at these values, radians or metres, in the frame of
//    the root link; joints that are not named are at 0, and "robot.urdf@" has
//    all at 0 (robot_pose.h).  Boxes, cylinders and spheres become meshes as in
//    problems/shapes.  Mesh files that are named there must lie in the file's
//    folder; those of package:// and model:// may lie in a folder above it.
// What the user should know (precision, unit, axes, shapes, joints) is appended
// to *warnings, one sentence each with the file's name; `warnings` may be null.
//
// As with ReadMesh, the mesh has valid indices and finite coordinates, and
// nothing else is checked.
//
// For files from strangers: if `root` is not empty, all files that are opened
// must be regular files below that folder, after following links and "..".
// Files that a glTF or COLLADA file names must always be regular files beside
// or below it, without links and ".." (files_beside.h).  Assimp runs in its own
// process, with limits of memory and time by the size of the file: if a file
// makes it fail, only that process ends.
//
// Throws InputError, one line "FILE: what, expected, found": like ReadMesh; for
// files without a mesh; for a link that does not exist, or is not named though
// there are several; for Assimp's formats in a build without it
// (PHONGPD_BUILD_ASSIMP).
TriangleMesh ReadAnyMesh(const std::string& path,
                         std::vector<std::string>* warnings = nullptr,
                         const std::string& root = "");

// A mesh as OMPL.app takes it: of Assimp's formats with the unit and the up
// axis that the file names applied, as Assimp does it.  `center` is the mean of
// the vertices, which Assimp counts once for each normal they have.
struct OmplAppMesh {
  TriangleMesh mesh;
  Eigen::Vector3d center;
};
OmplAppMesh ReadOmplAppMesh(const std::string& path,
                            std::vector<std::string>* warnings = nullptr,
                            const std::string& root = "");

}  // namespace phongpd
