// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

// The rows of phongpd compare: TrajectoryRow with the key `protocol`.
namespace phongpd {

// The rows of JSON Lines files, in whatever order, such as the parts of a
// comparison, of which some may be empty: a scene's rows follow each other by
// their seeds.  Throws InputError naming the file and the row: no JSON, refused
// by CheckComparisonRow, there twice (of one scene, seed, protocol and method),
// none at all, or a part missing (comparison_parts.h).
std::vector<nlohmann::ordered_json> JoinComparisons(
    const std::vector<std::string>& paths);

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
