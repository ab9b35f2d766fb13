// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/contact/contact_space.h"

// Operands, options and results of BuildContactSpace as bytes.  A field added
// to one of these structs does not compile until contact_space_bytes.cc names
// it; then caches written before are no longer used (see kFormat there), and
// saved files need another version (contact_space_file.cc).
namespace phongpd::internal {

// Everything the result depends on: bits of the coordinates, triangles, all
// options, the version of format and builder.
std::string KeyBytes(const TriangleMesh& robot, const TriangleMesh& obstacle,
                     const ContactSpaceOptions& options);

std::string ToBytes(const ContactSpace::Parts& space);
// False, with *space in no particular state, unless `bytes` is a contact
// space to the last byte, with valid indices, finite vertices, known kinds,
// planes below the number of triangles, and planes and kinds of all triangles
// or of none.
// Memory stays below 100 times the bytes, whatever they claim.
bool FromBytes(std::string_view bytes, ContactSpace::Parts* space);

// The size and the checksum of `content`, to stand before it in a file.
std::string Seal(std::string_view content);
inline constexpr std::size_t kSealBytes = 3 * sizeof(std::uint64_t);

}  // namespace phongpd::internal
