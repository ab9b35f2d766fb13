// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "results/bench/paper_measure.h"
#include "results/bench/report.h"

namespace phongpd::bench {

// Rows, of which paper_report.py makes the pages.
std::vector<NamedTable> PaperTables(const std::vector<PaperResult>& results,
                                    const PaperOptions& options);

}  // namespace phongpd::bench
