// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/contact/contact_space.h"

namespace phongpd {

// Contact spaces in files of their own format, ".pcs", which keep what mesh
// files lose: plane ids, kinds, the report, and D where WithLength gave one.
// What is read is what was written, bit for bit, so that every answer is.
//
// A file is a line of text, a byte order and the sizes of numbers, a version,
// the number of bytes that follow, their 128-bit checksum, and these bytes, the
// same that a cache keeps (contact_space_bytes.h).  Files are for machines of
// one kind: those of another kind or version are refused, and so is a file with
// one byte missing, changed or added.  A forged file passes the checksum, and
// is then checked as any mesh is: valid indices, finite vertices, closed.

// Does the path end in ".pcs", in any case?
bool NamesContactSpaceFile(const std::string& path);

// What WriteContactSpace writes.  Throws InputError if a file of that many
// bytes would not be read (kMaxMeshBytes).
std::string ContactSpaceContent(const ContactSpace& space);

// What ContactSpaceContent returned; `name` stands in the errors.  Throws
// InputError, one line "NAME: what, expected, found, how to mend it".
ContactSpace ParseContactSpace(const std::string& bytes,
                               const std::string& name);

// The same with files, whatever their names end in.  Writing is not atomic.
// Throw InputError, also when the file cannot be written and for what
// ReadInputFile refuses (core/mesh/mesh_io.h).
void WriteContactSpace(const ContactSpace& space, const std::string& path);
ContactSpace ReadContactSpace(const std::string& path);

}  // namespace phongpd
