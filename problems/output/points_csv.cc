// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/points_csv.h"

#include <array>

#include "core/mesh/input_file.h"
#include "problems/output/text.h"

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
  return ParsePointsCsv(ReadInputFile(path, "a CSV file", kMaxPointsBytes),
                        path);
}

std::vector<Eigen::Vector3d> ParsePointsCsv(std::string_view content,
                                            const std::string& file) {
  const auto take_line = [&content] {
    const std::size_t end = content.find('\n');
    const std::string_view line = content.substr(0, end);
    content.remove_prefix(end == std::string_view::npos ? content.size()
                                                        : end + 1);
    return line;
  };
  if (content.empty()) {
    throw InputError(file + ": expected a header with the columns x,y,z, " +
                     "found an empty file");
  }
  const Header header = ReadHeader(take_line(), file);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t number = 2; !content.empty(); ++number) {
    const std::string_view line = take_line();
    if (Trimmed(line).empty()) continue;
    const std::string where = file + ":" + std::to_string(number);
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
  return points;
}

}  // namespace phongpd
