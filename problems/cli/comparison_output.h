// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "problems/output/output_files.h"

namespace phongpd::cli {

// The table for people alone, of rows that are written nowhere.
std::string SummaryTable(const std::vector<nlohmann::ordered_json>& rows);

// Writes what a comparison leaves in `directory` besides rows.jsonl:
// summary.csv, rows.csv and the performance profiles.  Returns the table for
// people.  Throws InputError; RequireGnuplot comes first.
std::string WriteSummaries(const std::vector<nlohmann::ordered_json>& rows,
                           const std::string& directory, OutputFiles* outputs);

}  // namespace phongpd::cli
