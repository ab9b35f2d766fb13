// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/comparison_parts.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/mesh/mesh_error.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"
#include "problems/studies/comparison_rows.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

// Rows by the number of their problem, of one command, protocol and method.
struct Whole {
  std::map<int, int> rows;
  int parts = 1;
};

ComparisonPart ReadPart(const Json& part, const std::string& where) {
  ComparisonPart found;
  std::array<int*, 4> numbers = {&found.index, &found.count, &found.problem,
                                 &found.all_problems};
  bool is_right = part.is_array() && part.size() == numbers.size();
  for (std::size_t i = 0; is_right && i < numbers.size(); ++i) {
    is_right = part[i].is_number_integer();
    if (is_right) *numbers[i] = part[i].get<int>();
  }
  is_right = is_right && 0 <= found.index && found.index < found.count &&
             0 <= found.problem && found.problem < found.all_problems &&
             found.problem % found.count == found.index;
  if (is_right) return found;
  throw InputError(where +
                   ": expected at /part what compare --shard writes, [part, "
                   "parts, problem, problems], found " +
                   JsonText(part));
}

// Of so many parts at most it tells that they are missing.
constexpr int kMostNamed = 8;

// Throws InputError unless all problems have as many rows as any.
void RequireAll(const std::string& of, int problems, const Whole& whole) {
  int most = 0;
  for (const auto& entry : whole.rows) most = std::max(most, entry.second);
  int there = 0;
  for (const auto& entry : whole.rows) there += entry.second == most;
  if (there == problems) return;
  std::set<int> missing;
  const auto named =
      static_cast<std::size_t>(std::min(whole.parts, kMostNamed));
  // Numbers are those of a file: the loop ends long before `problems` if these
  // are beyond all sense.
  for (int i = 0; i < problems && missing.size() < named; ++i) {
    const auto found = whole.rows.find(i);
    if (found == whole.rows.end() || found->second < most) {
      missing.insert(i % whole.parts);
    }
  }
  std::vector<std::string> names;
  for (const int part : missing) {
    names.push_back(std::to_string(part) + "/" + std::to_string(whole.parts));
  }
  throw InputError("--rows: " + of + ": expected the rows of all " +
                   std::to_string(problems) + " problems, found those of " +
                   std::to_string(there) + " of " + std::to_string(problems) +
                   "; give rows.jsonl of part " + Joined(names) +
                   ", whole, too");
}

}  // namespace

void MarkPart(const ComparisonPart& part, Json* row) {
  if (part.IsWhole()) return;
  (*row)["part"] = {part.index, part.count, part.problem, part.all_problems};
}

void UnmarkAllParts(std::vector<Json>* rows) {
  // Commands may differ in how many parts and problems they have.
  std::map<std::array<std::string, 2>, std::map<std::array<int, 2>, Whole>>
      wholes;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    Json& row = (*rows)[i];
    const auto at = row.find("part");
    if (at == row.end()) continue;
    const ComparisonPart part = ReadPart(
        *at, RowText(row, "scene") + ", seed " + JsonText(row.at("seed")));
    row.erase("part");
    Whole& whole = wholes[{RowText(row, "protocol"), RowText(row, "method")}]
                         [{part.count, part.all_problems}];
    whole.parts = part.count;
    ++whole.rows[part.problem];
  }
  for (const auto& [of, commands] : wholes) {
    for (const auto& [numbers, whole] : commands) {
      RequireAll(of[0] + ", " + of[1], numbers[1], whole);
    }
  }
}

}  // namespace phongpd
