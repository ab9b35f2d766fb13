// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

// The rows of phongpd compare: TrajectoryRow with the key `protocol`.
namespace phongpd {

// The rows of a JSON Lines file.  Throws InputError naming the file and the
// row: no JSON, or refused by CheckComparisonRow.
std::vector<nlohmann::ordered_json> ReadComparison(const std::string& path);

// Throws InputError starting with `where` unless the row has every key that a
// comparison reads, of the right type.
void CheckComparisonRow(const nlohmann::ordered_json& row,
                        const std::string& where);

// A text, and a number by its path ("seconds/total"), of a checked row.
std::string RowText(const nlohmann::ordered_json& row, const char* key);
double RowNumber(const nlohmann::ordered_json& row, const std::string& path);

// The problem that methods compete on: scene and seed.
using ProblemKey = std::pair<std::string, long>;
ProblemKey ProblemOf(const nlohmann::ordered_json& row);

// The columns of a row that published tables need, as CSV with header.
std::string CompactCsv(const std::vector<nlohmann::ordered_json>& rows);

}  // namespace phongpd
