// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/number_text.h"

#include <array>
#include <charconv>
#include <cstdio>

namespace phongpd {

std::string FormatDouble(double value) {
  std::array<char, 32> buffer;
  const std::to_chars_result end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), end.ptr);
}

std::string FormatPoint(const Eigen::Vector3d& point) {
  return FormatDouble(point.x()) + ',' + FormatDouble(point.y()) + ',' +
         FormatDouble(point.z());
}

std::string Joined(const std::vector<std::string>& cells, const char* between) {
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += (i == 0 ? "" : between) + cells[i];
  }
  return text;
}

std::string Rounded(double value, int digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

}  // namespace phongpd
