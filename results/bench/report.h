// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "problems/output/text.h"

// Tables that are written once and shown as CSV, Markdown or text, and
// the circumstances every published figure comes with.
namespace phongpd::bench {

struct Table {
  std::string title;
  std::string note;  // one sentence under the title; may be empty
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

// What a cell shows: text as it is, numbers as counts and rounded.
inline std::string Shown(const std::string& text) { return text; }
inline std::string Shown(int count) { return std::to_string(count); }
inline std::string Shown(std::size_t count) { return std::to_string(count); }
inline std::string Shown(double value) { return Rounded(value); }

// A table of `items`: rows(item, add) calls add(cell, ...) for every row the
// item has.
template <typename Items, typename Rows>
Table MakeTable(std::string title, std::string note,
                std::vector<std::string> header, const Items& items,
                const Rows& rows) {
  Table table{std::move(title), std::move(note), std::move(header), {}};
  const auto add = [&table](const auto&... cells) {
    table.rows.push_back({Shown(cells)...});
  };
  for (const auto& item : items) rows(item, add);
  return table;
}

// Rows alone, for a report in Python to say what they are.
template <typename Items, typename Rows>
Table MakeTable(std::vector<std::string> header, const Items& items,
                const Rows& rows) {
  return MakeTable("", "", std::move(header), items, rows);
}

// A table of a report and the CSV file its rows are written to.
struct NamedTable {
  std::string file;
  Table table;
};

std::string ToCsv(const Table& table);
std::string ToMarkdown(const Table& table);
std::string ToText(const Table& table);  // aligned columns

// CPU time of the whole process, or of this thread, seconds: what a busy
// machine does not change.
double CpuSeconds();
double ThreadCpuSeconds();

// "CPU model, n cores, memory": nothing that names the host.
std::string Machine();

// "name version, name version, ..."
std::string VersionList();

// "Command: … Seed: … Machine: … Versions: …": under every report.
std::string Circumstances(const std::string& command, std::uint64_t seed);

// The program as it was called, without where it lies.
std::string CommandLine(const std::string& program, int argc, char** argv);

// Value below which the given fraction of `values` lies, linear between the two
// nearest: 0.5 is the median, of an even number the middle of the two in the
// middle.  Between a value and +infinity is +infinity.  0 when empty.
double Quantile(std::vector<double> values, double fraction);

}  // namespace phongpd::bench
