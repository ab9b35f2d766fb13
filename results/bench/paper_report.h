// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "results/bench/paper_measure.h"
#include "results/bench/report.h"

namespace phongpd::bench {

std::vector<NamedTable> PaperTables(const std::vector<PaperResult>& results,
                                    const PaperOptions& options);

// The few columns a terminal has room for.
Table ShortTable(const std::vector<PaperResult>& results);

// results/paper/README.md; `command` is how it was made.
std::string PaperReadme(const std::vector<PaperResult>& results,
                        const std::vector<NamedTable>& tables,
                        const std::vector<Figure>& figures,
                        const PaperOptions& options,
                        const std::string& command);

// One self-contained page with all tables and figures.
std::string PaperPage(const std::vector<NamedTable>& tables,
                      const std::vector<Figure>& figures,
                      const PaperOptions& options, const std::string& command);

}  // namespace phongpd::bench
