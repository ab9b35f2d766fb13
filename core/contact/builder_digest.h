// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd::internal {

// Of the sources of core/mesh to core/contact and the version of CGAL: a cached
// result of other code is never taken for one of this.
extern const char* const kBuilderDigest;

}  // namespace phongpd::internal
