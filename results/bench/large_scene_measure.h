// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "results/bench/report.h"

namespace phongpd::bench {

// A motion among two bodies of some 20 thousand triangles, planned and then
// optimised in free space alone, each judged on the original solids; and what a
// build of the whole contact space with `max_seconds` says.  In processes of
// their own: the caller must not have started threads.
NamedTable LargeSceneTable(double max_seconds);

// Triangles of both, facets of their convolution; in a process of its own, too.
NamedTable LargeSceneSize();

}  // namespace phongpd::bench
