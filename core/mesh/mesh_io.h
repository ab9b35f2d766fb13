// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The largest mesh file that is read; below it, every index fits an int.
inline constexpr std::uintmax_t kMaxMeshBytes = std::uintmax_t{1} << 31;

// Reads OFF, OBJ, STL or PLY, chosen by the file's extension in any case, in
// double precision as far as the file goes: binary OFF, binary STL and PLY
// with float properties hold floats.
//  - OFF, PLY and STL may be text or binary, lines may end in CR LF.
//  - OBJ: vertices and faces count, relative indices and v/vt/vn corners
//    work; everything else (materials, groups, lines, curves) is skipped.
//  - PLY needs float or double properties x, y, z of `vertex` and a list of
//    integers vertex_indices or vertex_index of `face`; the rest is skipped.
//  - Polygons with more corners are triangulated without new vertices, also
//    if they are not convex; faces with fewer than three are skipped.
//  - STL vertices with identical coordinates are joined, because the format
//    cannot express sharing.  The other formats come as they are.
// The result is a mesh with valid indices and finite coordinates, otherwise
// NOT checked: see MakeSolid, which also joins vertices where that closes it
// and bounds their size.  Every count in the file is checked against the bytes
// that follow before anything is allocated; memory stays below 100 times the
// file.
//
// Throws InputError, one line "FILE: what, expected, found": what
// ReadInputFile refuses (directories, devices, pipes that nobody writes to,
// files beyond kMaxMeshBytes; core/mesh/input_file.h), unknown extension,
// empty, unreadable or truncated content, counts that the file cannot hold, no
// face, numbers that no double holds, and with their counts non-finite
// coordinates and bad indices.
TriangleMesh ReadMesh(const std::string& path);

// Writes the mesh in the format of the extension (OFF, OBJ, STL, PLY; text
// with 17 significant digits, so that reading gives the same doubles).  STL
// keeps neither sharing nor unused vertices; the others keep every index.
// Throws InputError, before it writes anything, for an unknown extension,
// non-finite coordinates and bad indices, and when writing fails.
void WriteMesh(const TriangleMesh& mesh, const std::string& path);

// What WriteMesh writes to a file of this name.  Throws InputError like it.
std::string MeshContent(const TriangleMesh& mesh, const std::string& path);

}  // namespace phongpd
