// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

// Published rows read again: what ToCsv writes (report.h).
namespace phongpd::bench {

class CsvTable {
 public:
  // Cells by RFC 4180, the first line the header; `name` stands in errors.
  // Throws InputError where a row has not as many cells as the header.
  CsvTable(const std::string& text, std::string name);

  const std::vector<std::string>& header() const { return header_; }
  const std::vector<std::vector<std::string>>& rows() const { return rows_; }

  // A cell by the name of its column, which must exist; as a number, which it
  // must be.  Throw InputError.
  const std::string& Text(std::size_t row, const std::string& column) const;
  double Number(std::size_t row, const std::string& column) const;

 private:
  std::string name_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

// Of a file.  Throws InputError, also when it cannot be read.
CsvTable ReadCsvTable(const std::string& path);

}  // namespace phongpd::bench
