// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <thread>

#include "problems/output/text.h"
#include "problems/output/versions.h"

namespace phongpd::bench {
namespace {

// Columns a terminal needs for UTF-8 text.
std::size_t Width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(),
      [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string FieldOf(const char* file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const std::size_t colon = line.find(':');
    const std::size_t first = line.find_first_not_of(" \t", colon + 1);
    if (first != std::string::npos) return line.substr(first);
  }
  return "0 (unknown)";
}

double SecondsOn(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

std::string ToCsv(const Table& table) {
  std::string csv;
  const auto add = [&](std::vector<std::string> row) {
    for (std::string& cell : row) {
      cell = CsvCell(cell);
    }
    csv += Joined(row, ",") + '\n';
  };
  add(table.header);
  for (const auto& row : table.rows) add(row);
  return csv;
}

std::string ToMarkdown(const Table& table) {
  std::string text = "### " + table.title + "\n\n";
  if (!table.note.empty()) text += table.note + "\n\n";
  text += "| " + Joined(table.header, " | ") + " |\n|";
  for (std::size_t i = 0; i < table.header.size(); ++i) {
    text += i == 0 ? "---|" : "---:|";
  }
  text += '\n';
  for (const auto& row : table.rows) {
    text += "| " + Joined(row, " | ") + " |\n";
  }
  return text + '\n';
}

std::string ToText(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < table.header.size(); ++c) {
    std::size_t width = Width(table.header[c]);
    for (const auto& row : table.rows) width = std::max(width, Width(row[c]));
    widths.push_back(width);
  }
  std::string text = table.title + '\n';
  const auto add = [&](const std::vector<std::string>& row) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string padding(widths[c] - Width(row[c]), ' ');
      text += "  " + (c == 0 ? row[c] + padding : padding + row[c]);
    }
    text += '\n';
  };
  add(table.header);
  for (const auto& row : table.rows) add(row);
  return text;
}

double CpuSeconds() { return SecondsOn(CLOCK_PROCESS_CPUTIME_ID); }

double ThreadCpuSeconds() { return SecondsOn(CLOCK_THREAD_CPUTIME_ID); }

std::string Machine() {
  return FieldOf("/proc/cpuinfo", "model name") + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " cores, " +
         Rounded(std::stod(FieldOf("/proc/meminfo", "MemTotal")) / 1048576.0) +
         " GiB memory";
}

std::string VersionList() {
  std::string list;
  for (const auto& [name, version] : Versions()) {
    list += (list.empty() ? "" : ", ") + name + ' ' + version;
  }
  return list;
}

std::string Circumstances(const std::string& command, std::uint64_t seed) {
  return "Command: " + command + ". Seed: " + std::to_string(seed) +
         ". Machine: " + Machine() + ". Versions: " + VersionList() + ".";
}

std::string CommandLine(const std::string& program, int argc, char** argv) {
  std::string command = program;
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  return command;
}

double Quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below =
      values.begin() + static_cast<std::ptrdiff_t>(std::floor(place));
  std::nth_element(values.begin(), below, values.end());
  const double rest = place - std::floor(place);
  if (rest == 0.0) return *below;
  const double above = *std::min_element(below + 1, values.end());
  // Two infinities have no difference.
  if (above == *below) return *below;
  return *below + rest * (above - *below);
}

}  // namespace phongpd::bench
