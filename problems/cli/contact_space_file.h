// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/contact/contact_space.h"
#include "core/mesh/triangle_mesh.h"
#include "problems/output/output_files.h"

namespace phongpd::cli {

// Writes the mesh of a contact space, and in formats with comments (OFF, OBJ)
// a last line that says what it is.
void WriteContactSpaceTo(OutputFiles* outputs, const std::string& path,
                         const TriangleMesh& mesh);

// Reads a contact space: closed, edge-manifold, outward; rounding may have made
// some triangles meet.  Throws InputError naming the file.
ContactSpace LoadContactSpace(const std::string& path);

// Does the file say that it is a contact space?  OFF and OBJ files that
// WriteContactSpaceTo wrote do; no pipe does, which has been read.
bool IsMarkedContactSpace(const std::string& path);

// Any such mesh will do, but of a bracket's own every answer is that of a
// point, and nothing else would tell: says so on stderr unless the file says
// that it is a contact space.  For the end of a command that went well.
void TellIfTaken(const std::string& path);

}  // namespace phongpd::cli
