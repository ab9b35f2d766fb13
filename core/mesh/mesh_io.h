// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The largest mesh file that is read, 2 GiB: every index then fits an int.
inline constexpr std::uintmax_t kMaxMeshBytes = std::uintmax_t{1} << 31;

// Reads an OFF, OBJ, STL or PLY file, told by its extension in any case.
// Coordinates are in the file's own unit, in double precision; but binary OFF,
// binary STL and PLY with float properties contain single precision.
//  - OFF, PLY and STL may be text or binary.  Lines may end in CR LF.
//  - OBJ: vertices and faces are read, with relative indices and v/vt/vn
//    corners; all else (materials, groups, lines, curves) is skipped.
//  - PLY: the element `vertex` needs float or double properties x, y, z, and
//    `face` a list of integers, vertex_indices or vertex_index; all else is
//    skipped.
//  - Polygons with more than three corners are triangulated without new
//    vertices, also if they are not convex; those with fewer are skipped.
//  - STL vertices with identical coordinates are joined, because the format
//    cannot share vertices.  The other formats are read as they are.
// The mesh has valid indices and finite coordinates, and nothing else is
// checked: not whether it is closed, nor whether it bounds a solid.  For that
// call MakeSolid or ReadSolid (core/solid/solid.h).
//
// Safe for files from strangers: every count in the file is compared with the
// bytes that follow before anything is allocated, and memory stays below 100
// times the file.
//
// Throws InputError, one line "FILE: what, expected, found", for an unknown
// extension; for a directory, a device, a pipe that nobody writes to, or a file
// larger than kMaxMeshBytes (core/mesh/input_file.h); for content that is
// empty, truncated or not of the format; for counts that the file cannot
// contain; for a mesh without faces; for numbers too large for a double; and
// for non-finite coordinates and bad indices, with their number.
TriangleMesh ReadMesh(const std::string& path);

// Writes the mesh in the format of the extension (OFF, OBJ, STL or PLY), as
// text with 17 significant digits: reading it gives the same doubles.  STL
// keeps neither shared nor unused vertices; the other formats keep every index.
// Throws InputError if writing fails; and, before it writes anything, for an
// unknown extension, non-finite coordinates and bad indices.
void WriteMesh(const TriangleMesh& mesh, const std::string& path);

// The bytes that WriteMesh would write to a file of this name.  Throws
// InputError like WriteMesh.
std::string MeshContent(const TriangleMesh& mesh, const std::string& path);

}  // namespace phongpd
