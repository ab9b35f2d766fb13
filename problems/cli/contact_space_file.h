// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/contact/contact_space.h"
#include "problems/output/output_files.h"

namespace phongpd::cli {

// Declares a contact space as output: a .pcs file, which keeps planes, kinds,
// report and D, or a mesh; fails now if its extension means neither.
void DeclareContactSpace(OutputFiles* outputs, const std::string& path);

// Writes it; to mesh formats with comments (OFF, OBJ) with a last line that
// says what it is.
void WriteContactSpaceTo(OutputFiles* outputs, const std::string& path,
                         const ContactSpace& space);

// Reads a contact space: a .pcs file as it was, or a mesh that is closed,
// edge-manifold and outward; rounding may have made some triangles meet.
// Throws InputError naming the file.
ContactSpace LoadContactSpace(const std::string& path);

// Does the file say that it is a contact space?  A .pcs file does, and OFF and
// OBJ files that WriteContactSpaceTo wrote; no pipe does, which has been read.
bool IsMarkedContactSpace(const std::string& path);

// Any such mesh will do, but of a bracket's own every answer is that of a
// point, and nothing else would tell: says so on stderr unless the file says
// that it is a contact space.  For the end of a command that went well.
void TellIfTaken(const std::string& path);

}  // namespace phongpd::cli
