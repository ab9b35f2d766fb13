// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "core/contact/contact_space.h"

namespace phongpd {

// A folder of earlier results of BuildContactSpace.
struct ContactSpaceCache {
  std::string directory;  // created (0700) when needed; empty: no cache
  // Of all files together; the longest unused ones are removed first.
  std::uintmax_t max_bytes = std::uintmax_t{512} << 20;
};

// $PHONGPD_CACHE_DIR, else $XDG_CACHE_HOME/phongpd, else $HOME/.cache/phongpd;
// the last two must be absolute.  Empty when none is set.
std::string DefaultCacheDirectory();

// BuildContactSpace, or what it returned before for the same operands, bit for
// bit, the same options and the same version of the library.  Mesh, plane ids,
// kinds and report are those of the first build, bit for bit (its seconds
// too), but for report.from_cache.
//
// A cache that cannot be read or written is no error, just no cache.  A file
// that is truncated or changed is detected (128-bit checksum), built anew,
// replaced, and named in report.warnings.  Files appear under their name only
// when complete, so any number of processes of one user may share the folder.
// Contents forged on purpose would pass, so only folders and files are used
// that are the user's own and that nobody else may write to; others, and links
// where a file should be, are not read, and named in report.warnings.
//
// Throws what BuildContactSpace throws; failures are not kept.
ContactSpace BuildContactSpaceCached(const Solid& robot, const Solid& obstacle,
                                     const ContactSpaceOptions& options,
                                     const ContactSpaceCache& cache);
ContactSpace BuildContactSpaceCached(const TriangleMesh& robot,
                                     const TriangleMesh& obstacle,
                                     const ContactSpaceOptions& options,
                                     const ContactSpaceCache& cache);

}  // namespace phongpd
