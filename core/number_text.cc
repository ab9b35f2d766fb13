// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "core/mesh/mesh_error.h"

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

double ParseDouble(std::string_view text, const std::string& what) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') {
    digits.remove_prefix(1);
  }
  double value = 0.0;
  const char* const end = digits.data() + digits.size();
  const std::from_chars_result read =
      std::from_chars(digits.data(), end, value);
  bool good = read.ptr == end && !digits.empty();
  if (good && read.ec == std::errc::result_out_of_range) {
    // from_chars does not say whether it is too large or too small.
    value = std::strtod(std::string(digits).c_str(), nullptr);
  } else if (read.ec != std::errc()) {
    good = false;
  }
  if (!good || !std::isfinite(value)) {
    constexpr std::size_t kLongest = 40;
    std::string found(text.substr(0, kLongest));
    for (char& c : found) {
      if (c < ' ' || c == '\x7f') c = '?';
    }
    throw InputError(what + ": expected a finite number, found '" + found +
                     (text.size() > kLongest ? "...'" : "'"));
  }
  return value;
}

std::string Rounded(double value, int digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

}  // namespace phongpd
