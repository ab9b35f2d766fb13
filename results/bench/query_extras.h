// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "results/bench/query_cases.h"
#include "results/bench/query_rows.h"

namespace phongpd::bench {

// Batches, the whole program and memory, on those of `spaces` that are nearest
// to 10⁴ triangles.  Throws InputError where `phongpd` does not run.
QueryExtras MeasureExtras(const std::vector<QuerySpace>& spaces,
                          const std::string& phongpd);

}  // namespace phongpd::bench
