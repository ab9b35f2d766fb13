// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// Reads OFF, OBJ, STL (ASCII or binary) or PLY by the file's extension, in
// double precision, through CGAL's polygon-soup readers.  Polygons with more
// than three corners are triangulated as fans around their first corner.
// STL vertices with identical coordinates are joined, because the format
// cannot express sharing.  The result is NOT checked: see MakeSolid.
//
// Throws InputError: missing file, unknown extension, unreadable content (or
// no triangle), non-finite coordinates with their count.
TriangleMesh ReadMesh(const std::string& path);

// Writes the mesh in the format of the extension (OFF, OBJ, STL, PLY; text
// with 17 significant digits, so that reading gives the same doubles).
// Throws InputError when the file cannot be written or the extension is
// unknown.
void WriteMesh(const TriangleMesh& mesh, const std::string& path);

}  // namespace phongpd
