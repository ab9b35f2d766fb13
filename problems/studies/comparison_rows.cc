// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/comparison_rows.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "core/mesh/input_file.h"
#include "core/mesh/mesh_error.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"
#include "problems/studies/comparison_parts.h"

namespace phongpd {

namespace {

using Json = nlohmann::ordered_json;

// A row, and where it was read.
struct ReadRow {
  Json row;
  std::string where;
};

void ReadRows(const std::string& path, std::vector<ReadRow>* rows) {
  constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 30;
  std::istringstream file(
      ReadInputFile(path, "rows of phongpd compare", kMaxBytes));
  int count = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty()) continue;
    const std::string where = path + ": row " + std::to_string(++count);
    Json row = Json::parse(line, nullptr, false);
    if (!row.is_object()) {
      throw InputError(where + ": expected a JSON object, found " +
                       line.substr(0, 40));
    }
    CheckComparisonRow(row, where);
    rows->push_back({std::move(row), where});
  }
}

std::vector<Json> RowsAlone(std::vector<ReadRow> read) {
  std::vector<Json> rows;
  for (ReadRow& one : read) rows.push_back(std::move(one.row));
  return rows;
}

// What no two rows of a comparison are of.
std::string CellOf(const Json& row) {
  return RowText(row, "scene") + ", seed " + JsonText(row.at("seed")) + ", " +
         RowText(row, "protocol") + ", " + RowText(row, "method");
}

void RefuseRepeated(const std::vector<ReadRow>& rows) {
  std::map<std::string, const ReadRow*> found;
  for (const ReadRow& read : rows) {
    const auto [at, is_new] = found.emplace(CellOf(read.row), &read);
    if (is_new) continue;
    throw InputError(read.where + ": expected every row once, found " +
                     at->first + " as " + at->second->where +
                     "; leave one of them out");
  }
}

}  // namespace

std::string RowText(const Json& row, const char* key) {
  return row.at(key).get<std::string>();
}

double RowNumber(const Json& row, const std::string& path) {
  return row.at(Json::json_pointer("/" + path)).get<double>();
}

ProblemKey ProblemOf(const Json& row) {
  return {RowText(row, "scene"), row.at("seed").get<long>()};
}

void CheckComparisonRow(const Json& row, const std::string& where) {
  using Kind = Json::value_t;
  static const std::vector<std::pair<const char*, Kind>> keys = {
      {"/scene", Kind::string},
      {"/protocol", Kind::string},
      {"/method", Kind::string},
      {"/seed", Kind::number_integer},
      {"/status", Kind::string},
      {"/status_class", Kind::string},
      {"/solved", Kind::boolean},
      {"/solver_claims_solved", Kind::boolean},
      {"/solver_path_free", Kind::boolean},
      {"/collision_free", Kind::boolean},
      {"/iterations", Kind::number_integer},
      {"/restoration_iterations", Kind::number_integer},
      {"/evaluations/jacobian", Kind::number_integer},
      {"/objective", Kind::number_float},
      {"/inf_pr", Kind::number_float},
      {"/inf_du", Kind::number_float},
      {"/lengths/clearance/share", Kind::number_float},
      {"/missing_clearance", Kind::number_float},
      {"/queries/branch_ends", Kind::number_integer},
      {"/seconds/callbacks", Kind::number_float},
      {"/seconds/total", Kind::number_float}};
  for (const auto& [key, kind] : keys) {
    const Json::json_pointer place(key);
    const bool is_there = row.is_object() && row.contains(place);
    const bool is_right =
        is_there &&
        (kind == Kind::number_float     ? row.at(place).is_number()
         : kind == Kind::number_integer ? row.at(place).is_number_integer()
                                        : row.at(place).type() == kind);
    if (is_right) continue;
    throw InputError(where + ": expected a row of phongpd compare with a " +
                     (kind == Kind::string         ? "text"
                      : kind == Kind::boolean      ? "true or false"
                      : kind == Kind::number_float ? "number"
                                                   : "whole number") +
                     " at " + key + ", found " +
                     (is_there ? JsonText(row.at(place)) : "none"));
  }
}

std::string CompactCsv(const std::vector<Json>& rows) {
  TextStream csv;
  csv << "scene,protocol,method,seed,status,status_class,solved,"
         "solver_claims_solved,collision_free,iterations,"
         "restoration_iterations,jacobian_evaluations,objective,inf_pr,inf_du,"
         "clearance,missing_clearance,branch_ends,seconds_callbacks,seconds_"
         "total\n";
  for (const Json& row : rows) {
    csv << CsvCell(RowText(row, "scene")) << ',' << RowText(row, "protocol")
        << ',' << RowText(row, "method") << ',' << row.at("seed") << ','
        << RowText(row, "status") << ',' << RowText(row, "status_class") << ','
        << row.at("solved") << ',' << row.at("solver_claims_solved") << ','
        << row.at("collision_free") << ',' << row.at("iterations") << ','
        << row.at("restoration_iterations") << ','
        << row.at("evaluations").at("jacobian") << ','
        << Rounded(RowNumber(row, "objective"), 8) << ','
        << Rounded(RowNumber(row, "inf_pr")) << ','
        << Rounded(RowNumber(row, "inf_du")) << ','
        << Rounded(RowNumber(row, "lengths/clearance/share"), 4) << ','
        << Rounded(RowNumber(row, "missing_clearance"), 4) << ','
        << row.at("queries").at("branch_ends") << ','
        << Rounded(RowNumber(row, "seconds/callbacks")) << ','
        << Rounded(RowNumber(row, "seconds/total")) << '\n';
  }
  return csv.str();
}

std::vector<Json> JoinComparisons(const std::vector<std::string>& paths) {
  std::vector<ReadRow> read;
  for (const std::string& path : paths) ReadRows(path, &read);
  if (read.empty()) {
    throw InputError(Joined(paths) + ": expected rows, found none");
  }
  RefuseRepeated(read);
  std::map<std::string, std::size_t> scenes;  // in the order they are met
  for (const ReadRow& one : read) {
    scenes.emplace(RowText(one.row, "scene"), scenes.size());
  }
  const auto problem = [&](const ReadRow& one) {
    const auto [scene, seed] = ProblemOf(one.row);
    return std::make_pair(scenes.at(scene), seed);
  };
  std::stable_sort(read.begin(), read.end(),
                   [&](const ReadRow& a, const ReadRow& b) {
                     return problem(a) < problem(b);
                   });
  std::vector<Json> rows = RowsAlone(std::move(read));
  UnmarkAllParts(&rows);
  return rows;
}

}  // namespace phongpd
