// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "core/contact/contact_space.h"

namespace phongpd {

// A folder of earlier results of BuildContactSpace.
struct ContactSpaceCache {
  std::string directory;  // created (0700) when needed; empty: no cache
  // Of all files together; those unused for longest are removed first.
  std::uintmax_t max_bytes = std::uintmax_t{512} << 20;
};

// $PHONGPD_CACHE_DIR, else $XDG_CACHE_HOME/phongpd, else $HOME/.cache/phongpd;
// the last two must be absolute.  Empty when none is set.
std::string DefaultCacheDirectory();

// BuildContactSpace, or what it returned before for the same operands (bit for
// bit), the same options and the same version of the library.  Mesh, plane ids,
// kinds and report are those of the first build, bit for bit and with its
// seconds; only report.from_cache differs.
//
// A cache that cannot be read or written is no error: the space is built.  A
// file that is cut short or changed is found out by its 128-bit checksum, built
// anew, replaced, and named in report.warnings.  A file gets its name when it
// is complete, so any number of processes of one user may share the folder.
// The checksum does not protect from forgery, so only folders and files are
// used that belong to the user and that nobody else may write to.  Others, and
// links in place of files, are not read, and are named in report.warnings.
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
