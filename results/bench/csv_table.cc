// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/csv_table.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "problems/output/text.h"

namespace phongpd::bench {
namespace {

std::vector<std::vector<std::string>> Cut(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row;
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        cell += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cell += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',' || c == '\n') {
      row.push_back(std::move(cell));
      cell.clear();
      if (c == '\n') rows.push_back(std::exchange(row, {}));
    } else if (c != '\r') {
      cell += c;
    }
  }
  if (!cell.empty() || !row.empty()) {
    row.push_back(std::move(cell));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

CsvTable::CsvTable(const std::string& text, std::string name)
    : name_(std::move(name)), rows_(Cut(text)) {
  if (rows_.empty())
    throw InputError(name_ + ": expected a header, found none");
  header_ = std::move(rows_.front());
  rows_.erase(rows_.begin());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].size() != header_.size()) {
      throw InputError(name_ + ": row " + std::to_string(i + 1) +
                       ": expected " + std::to_string(header_.size()) +
                       " cells, found " + std::to_string(rows_[i].size()));
    }
  }
}

const std::string& CsvTable::Text(std::size_t row,
                                  const std::string& column) const {
  const auto at = std::find(header_.begin(), header_.end(), column);
  if (at == header_.end()) {
    throw InputError(name_ + ": expected a column '" + column + "', found " +
                     Joined(header_));
  }
  return rows_.at(row)[static_cast<std::size_t>(at - header_.begin())];
}

double CsvTable::Number(std::size_t row, const std::string& column) const {
  return ParseDouble(
      Text(row, column),
      name_ + ": row " + std::to_string(row + 1) + ": " + column);
}

CsvTable ReadCsvTable(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be read");
  return {{std::istreambuf_iterator<char>(file), {}}, path};
}

}  // namespace phongpd::bench
