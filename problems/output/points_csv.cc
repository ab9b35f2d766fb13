// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/output/points_csv.h"

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

// What may stand in a message.
std::string Excerpt(std::string_view line) {
  constexpr std::size_t kLongest = 40;
  line = Trimmed(line);
  std::string text(line.substr(0, kLongest));
  for (char& c : text) {
    if (c < ' ' || c == '\x7f') c = '?';
  }
  return text + (line.size() > kLongest ? "..." : "");
}

using Names = std::vector<std::string>;

struct Header {
  std::size_t columns = 0;
  std::vector<std::size_t> place;  // of each name
};

std::string WithCommas(const Names& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ",") + name;
  }
  return text;
}

Header ReadHeader(std::string_view line, const Names& names,
                  const std::string& path) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (line.substr(0, 3) == kByteOrderMark) line.remove_prefix(3);
  const std::vector<std::string_view> cells = Cells(line);
  Header header;
  header.columns = cells.size();
  for (const std::string& name : names) {
    std::size_t found = 0, place = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (cells[c] != name) continue;
      place = c;
      ++found;
    }
    if (found != 1) {
      throw InputError(path + ":1: expected a header with the columns " +
                       WithCommas(names) + ", found column " + name + " " +
                       std::to_string(found) + " times in '" + Excerpt(line) +
                       "'; put " + WithCommas(names) +
                       " on the first line, with commas");
    }
    header.place.push_back(place);
  }
  return header;
}

// Calls row(values in the order of the names, "file:line") for every row.
template <typename Row>
void ParseColumns(std::string_view content, const std::string& file,
                  const Names& names, const Row& row) {
  const auto take_line = [&content] {
    const std::size_t end = content.find('\n');
    const std::string_view line = content.substr(0, end);
    content.remove_prefix(end == std::string_view::npos ? content.size()
                                                        : end + 1);
    return line;
  };
  if (content.empty()) {
    throw InputError(file + ": expected a header with the columns " +
                     WithCommas(names) + ", found an empty file");
  }
  const Header header = ReadHeader(take_line(), names, file);
  std::vector<double> values(names.size());
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
    for (std::size_t k = 0; k < names.size(); ++k) {
      values[k] =
          ParseDouble(cells[header.place[k]], where + ": column " + names[k]);
    }
    row(values, where);
  }
}

}  // namespace

std::vector<Eigen::Vector3d> ReadPointsCsv(const std::string& path) {
  return ParsePointsCsv(ReadInputFile(path, "a CSV file", kMaxPointsBytes),
                        path);
}

std::vector<Eigen::Vector3d> ParsePointsCsv(std::string_view content,
                                            const std::string& file) {
  std::vector<Eigen::Vector3d> points;
  ParseColumns(content, file, {"x", "y", "z"},
               [&](const std::vector<double>& v, const std::string&) {
                 points.emplace_back(v[0], v[1], v[2]);
               });
  return points;
}

std::vector<RobotPose> ReadPosesCsv(const std::string& path) {
  return ParsePosesCsv(ReadInputFile(path, "a CSV file", kMaxPointsBytes),
                       path);
}

std::vector<RobotPose> ParsePosesCsv(std::string_view content,
                                     const std::string& file) {
  std::vector<RobotPose> poses;
  ParseColumns(content, file, {"x", "y", "z", "qw", "qx", "qy", "qz"},
               [&](const std::vector<double>& v, const std::string& where) {
                 RobotPose pose;
                 pose.position = {v[0], v[1], v[2]};
                 pose.orientation = {v[3], v[4], v[5], v[6]};
                 CheckPose(pose, where);
                 poses.push_back(pose);
               });
  return poses;
}

}  // namespace phongpd
