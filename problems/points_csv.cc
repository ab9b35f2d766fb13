// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/points_csv.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "problems/text.h"

namespace phongpd {
namespace {

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(Trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

struct Header {
  std::size_t columns = 0;
  std::array<std::size_t, 3> place;  // of x, y and z
};

Header ReadHeader(std::string_view line, const std::string& path) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (line.substr(0, 3) == kByteOrderMark) line.remove_prefix(3);
  const std::vector<std::string_view> cells = Cells(line);
  Header header;
  header.columns = cells.size();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string_view name = std::string_view("xyz").substr(k, 1);
    std::size_t found = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (cells[c] != name) continue;
      header.place[k] = c;
      ++found;
    }
    if (found != 1) {
      throw InputError(path + ":1: expected a header with the columns x,y,z, " +
                       "found column " + std::string(name) + " " +
                       std::to_string(found) + " times");
    }
  }
  return header;
}

}  // namespace

std::vector<Eigen::Vector3d> ReadPointsCsv(const std::string& path) {
  if (std::filesystem::is_directory(path)) {
    throw InputError(path + ": expected a CSV file, found a directory");
  }
  std::ifstream file(path);
  if (!file) {
    throw InputError(path + ": cannot be read (" + std::strerror(errno) + ")");
  }
  std::string line;
  if (!std::getline(file, line)) {
    throw InputError(path + ": expected a header with the columns x,y,z, " +
                     "found an empty file");
  }
  const Header header = ReadHeader(line, path);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t number = 2; std::getline(file, line); ++number) {
    if (Trimmed(line).empty()) continue;
    const std::string where = path + ":" + std::to_string(number);
    const std::vector<std::string_view> cells = Cells(line);
    if (cells.size() != header.columns) {
      throw InputError(where + ": expected " + std::to_string(header.columns) +
                       " cells as in the header, found " +
                       std::to_string(cells.size()));
    }
    Eigen::Vector3d& point = points.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      point[static_cast<int>(k)] =
          ParseDouble(cells[header.place[k]],
                      where + ": column " + std::string(1, "xyz"[k]));
    }
  }
  if (file.bad()) throw InputError(path + ": reading stopped half-way");
  return points;
}

}  // namespace phongpd
