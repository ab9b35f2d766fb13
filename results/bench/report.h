// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

// Tables that are written once and shown as CSV, Markdown, HTML or text, and
// the circumstances every published figure comes with.
namespace phongpd::bench {

struct Table {
  std::string title;
  std::string note;  // one sentence under the title; may be empty
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

std::string ToCsv(const Table& table);
std::string ToMarkdown(const Table& table);
std::string ToHtml(const Table& table);
std::string ToText(const Table& table);  // aligned columns

// `value` with the given number of significant digits.
std::string Rounded(double value, int digits = 3);

// "CPU model, n cores, memory": nothing that names the host.
std::string Machine();

// "name version, name version, ..."
std::string VersionList();

// Value below which the given fraction of `values` lies; 0 when empty.
double Quantile(std::vector<double> values, double fraction);

}  // namespace phongpd::bench
