// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

// What the rows of a part of a comparison say of the whole, so that a part that
// is lost is missed.
namespace phongpd {

// A problem is a scene and a seed; the whole command has them by number, and
// part i/n has those whose number leaves i when divided by n.
struct ComparisonPart {
  int index = 0, count = 1;           // i and n
  int problem = 0, all_problems = 0;  // the row's, from 0, and of the whole

  bool IsWhole() const { return count == 1; }
};

// Adds the key `part`: [i, n, problem, problems of the whole]; nothing to a row
// of a command that was not parted.
void MarkPart(const ComparisonPart& part, nlohmann::ordered_json* row);

// Takes the key away again.  Rows without it are left alone.  Throws InputError
// if `part` is no such list, or unless every protocol and method has each
// problem of its whole: it then names the parts that are missing.  (Where rows
// of several commands come together, each problem as often as any other.)
void UnmarkAllParts(std::vector<nlohmann::ordered_json>* rows);

}  // namespace phongpd
